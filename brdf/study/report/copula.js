// The density of a fitted copula: colours by its logarithm and contours.

const copula_rows = () => rows_of(chosen.material).filter((row) => row.curves?.copulas.length > 0);
const copula_row = () => copula_rows().find((row) => row.name === element('copula-model').value);

/// The share of the colours that a density has: 0 at the first level, 1 at the last.
const density_share = (density) => Math.min(1, Math.max(0, Math.log(Math.max(density, 1e-300) / kLevels[0]) / Math.log(kLevels.at(-1) / kLevels[0])));

function paint_density(canvas, density) {
  const count = density.length, side = canvas.width;
  const context = canvas.getContext('2d');
  const small = make('canvas', {width: count, height: count});
  const pixels = new ImageData(count, count);
  density.forEach((row, i) => row.forEach((value, j) =>
    pixels.data.set([...data.colour_map[Math.round(255 * density_share(value))], 255], 4 * ((count - 1 - j) * count + i))));
  small.getContext('2d').putImageData(pixels, 0, 0);
  context.drawImage(small, 0, 0, side, side);
  for (const level of kLevels) {
    context.strokeStyle = level < 2 ? '#ffffffb0' : '#000000a0';
    context.lineWidth = side / 300 * (level === 1 ? 2 : 1);
    context.beginPath();
    for (const [a, b] of contour(density, level)) {
      context.moveTo((a[0] + 0.5) / count * side, (1 - (a[1] + 0.5) / count) * side);
      context.lineTo((b[0] + 0.5) / count * side, (1 - (b[1] + 0.5) / count) * side);
    }
    context.stroke();
  }
}

function draw_copula() {
  const copula = copula_row().curves.copulas[Number(element('copula-place').value)];
  paint_density(element('copula-canvas'), copula.density);
  const text = `${copula_row().name}, ${place_text(copula)}: Kendall's τ ${show(copula.tau, {digits: 3})}.`;
  element('copula-canvas').setAttribute('aria-label', `Density of the copula of ${text}`);
  element('copula-caption').textContent = `${text} Contours at ${kLevels.join(', ')}; the thick one is 1, independence.`;
}

function place_text({theta_d, component}) {
  const several = copula_row().curves.copulas.some((copula) => copula.component !== component);
  return `θd = ${theta_d}°${several ? `, component ${component}` : ''}`;
}

function fill_copula_places() {
  const {copulas} = copula_row().curves;
  const strongest = copulas.reduce((best, copula, n) => (Math.abs(copula.tau) > Math.abs(copulas[best].tau) ? n : best), 0);
  fill_select(element('copula-place'), copulas.map((copula, n) => [String(n), place_text(copula)]), String(strongest));
  draw_copula();
}

function fill_copula() {
  const rows = copula_rows();
  element('copula').hidden = rows.length === 0;
  if (rows.length === 0) return;
  const first = rows.find((row) => row.curves.copulas.some(({tau}) => tau !== 0)) ?? rows[0];
  fill_select(element('copula-model'), rows.map(({name}) => [name, name]), first.name);
  fill_copula_places();
}

function start_copula() {
  element('copula-model').onchange = fill_copula_places;
  element('copula-place').onchange = draw_copula;
  paint_colour_bar(element('copula-bar').querySelector('canvas'));
}
