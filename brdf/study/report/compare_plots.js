// What the plots show.

/// A line for the reference, wide, and one for each chosen model; values(curves) or null where there are none.
function lines(x, values) {
  return shown_models().filter((model) => model.curves).map((model) => ({
    label: model.name,
    colour: model.colour,
    width: model.row ? 2 : 4,
    order: model.row ? 0 : 1,
    x,
    y: values(model.curves),
  }));
}

function draw_lobes() {
  const index = Number(element('theta-i').value);
  const theta_i = data.axes.lobe_theta_i[index];
  const scale = radio_value('lobe-scale');
  element('theta-i-text').textContent = `${theta_i}°`;
  element('theta-i').setAttribute('aria-valuetext', `${theta_i} degrees`);
  const series = lines(data.axes.lobe_theta_o, (curves) => curves.lobes[index]);
  draw_plot('lobes', {
    x: {label: 'θₒ (degrees), mirror side to the right', scale: 'linear', low: -90, high: 90, ticks: [-90, -60, -30, 0, 30, 60, 90]},
    y: {label: 'luminance of f (1/sr)', scale, low: scale === 'log' ? undefined : 0, decades: 6},
    series,
    marks: [{x: theta_i, label: 'mirror direction'}],
    by_x: true,
    about: `Reflectance in the plane of incidence for light at ${theta_i} degrees: ${series.map(({label}) => label).join('; ')}`,
  });
}

function draw_albedo() {
  const channel = Number(radio_value('channel'));
  const series = lines(data.axes.albedo_theta_o, (curves) => curves.albedo[channel]);
  draw_plot('albedo', {
    x: {label: 'θₒ (degrees)', scale: 'linear', low: 0, high: 90, ticks: [0, 15, 30, 45, 60, 75, 90]},
    y: {label: 'directional albedo', scale: 'linear', low: 0},
    series,
    by_x: true,
    about: `Directional albedo by angle: ${series.map(({label}) => label).join('; ')}`,
  });
}

function draw_margins() {
  const share = {label: 'share per bin', scale: 'linear', low: 0};
  const about = (angle) => `Margin of the ${angle}, reference and chosen models`;
  draw_plot('theta_h', {
    x: {label: 'half angle (degrees)', scale: 'sqrt', low: 0, high: 90, ticks: [0, 1, 5, 15, 30, 60, 90]},
    y: share,
    series: lines(data.axes.theta_h, (curves) => curves.theta_h),
    by_x: true,
    about: about('half angle'),
  });
  draw_plot('phi_d', {
    x: {label: 'difference azimuth (degrees)', scale: 'linear', low: 0, high: 180, ticks: [0, 45, 90, 135, 180]},
    y: share,
    series: lines(data.axes.phi_d, (curves) => curves.phi_d),
    by_x: true,
    about: about('difference azimuth'),
  });
}

const kShapes = {copula: 'circle', analytic: 'triangle', basis: 'rect'};

function cost_points(cost, error) {
  const sign = kColumns[error].better === 'lower' ? 1 : -1;
  return rows_of(chosen.material)
    .map((row) => ({row, x: number_of(row[cost]), value: number_of(row[error]), y: sign * number_of(row[error])}))
    .filter((point) => point.x > 0 && Number.isFinite(point.value));
}

/// The points that a logarithmic axis of the error shows, and those too low for it: what reproduces the table.
function split_low(points, lower) {
  const kDecades = 5;
  const floor = lower ? Math.max(...points.map(({value}) => value)) / 10 ** kDecades : -Infinity;
  return [points.filter(({value}) => value >= floor), points.filter(({value}) => value < floor)];
}

function draw_cost() {
  const cost = radio_value('cost'), error = element('error').value;
  const theme = theme_colours();
  const lower = kColumns[error].better === 'lower';
  const [points, below] = split_low(cost_points(cost, error), lower);
  const best = front(points);
  const label = ({row}) => (chosen.colours.has(row.name) || best.some((point) => point.row === row) ? row.name : '');
  const group = (kind) => {
    const members = points.filter(({row}) => (row.kind ?? 'copula') === kind);
    const colours = members.map(({row}) => chosen.colours.get(row.name) ?? theme.muted);
    return {label: kind, colour: colours, shape: kShapes[kind], points: 6, x: members.map((point) => point.x),
      y: members.map((point) => point.value), names: members.map(({row}) => row.name), notes: members.map(label)};
  };
  const line = {label: 'best', colour: theme.muted, width: 1, order: 1, dash: [2, 3],
    stepped: 'before', x: best.map((point) => point.x), y: best.map((point) => point.value)};
  const unit = kColumns[error].unit ? ` (${kColumns[error].unit})` : '';
  const kinds = Object.keys(kShapes).filter((kind) => points.some(({row}) => (row.kind ?? 'copula') === kind));
  draw_plot('cost', {
    x: {label: cost === 'bytes' ? 'size (bytes)' : 'time of an RGB value (ns)', scale: 'log'},
    y: {label: `${kColumns[error].heading}${unit}, ${kColumns[error].better} is better`, scale: lower ? 'log' : 'linear'},
    series: [line, ...kinds.map(group)],
    about: `${kColumns[error].heading} against ${kColumns[cost].heading}. Best: ${best.map(({row}) => row.name).join('; ')}`,
    caption: (kinds.length > 1 ? 'Circles: copula models. Triangles: analytic models. Squares: data-driven models.' : '')
      + (below.length > 0 ? ` Below the plot: ${below.map(({row}) => row.name).join(', ')}.` : ''),
  });
}
