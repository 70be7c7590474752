// Plots by Chart.js, whose own linear scale carries every scale here: a point is placed by `to` of its axis.

const kScales = {
  linear: {to: (v) => v, ticks: linear_ticks},
  log: {to: (v) => (v > 0 ? Math.log10(v) : NaN), ticks: log_ticks},
  cbrt: {to: Math.cbrt, ticks: (low, high) => spread_ticks(Math.cbrt, low, high)},
  digits: {to: (v) => (v > 0 && v < 1 ? -Math.log10(-Math.log10(v)) : NaN), ticks: digit_ticks},
  sqrt: {to: Math.sqrt, ticks: (low, high) => spread_ticks(Math.sqrt, low, high)},
};

function linear_ticks(low, high) {
  const raw = (high - low) / 6;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw);
  const ticks = [];
  for (let n = Math.ceil(low / step); n * step <= high * (1 + 1e-9); ++n) ticks.push(n * step);
  return ticks;
}

function log_ticks(low, high, factors = Math.log10(high / low) < 2.5 ? [1, 2, 5] : [1]) {
  const first = Math.floor(Math.log10(low)), last = Math.ceil(Math.log10(high));
  const ticks = [];
  for (let n = first; n <= last; ++n) {
    for (const factor of factors) ticks.push(Number(`${factor}e${n}`));
  }
  return ticks.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

/// Powers of ten whose exponents stand apart on the scale of digits.
function digit_ticks(low, high) {
  return [1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300].map((n) => Number(`1e-${n}`))
    .filter((tick) => tick >= low && tick <= high).reverse();
}

/// 0 and numbers 1, 2, 5 times a power of ten that stand apart on the scale.
function spread_ticks(to, low, high) {
  const apart = (to(high) - to(low)) / 9;
  const ticks = [];
  for (const tick of log_ticks(high / 1e6, high, [1, 2, 5]).reverse()) {
    if (ticks.length === 0 || to(ticks[ticks.length - 1]) - to(tick) >= apart) ticks.push(tick);
  }
  return [0, ...ticks.filter((tick) => to(tick) - to(low) >= apart).reverse()];
}

/// A tick's number: few digits, powers of ten where it is far from 1.
function tick_text(value) {
  if (value === 0) return '0';
  const power = Math.floor(Math.log10(Math.abs(value)) + 1e-9);
  if (power >= -3 && power <= 4) return Number(value.toPrecision(3)).toLocaleString('en', {maximumFractionDigits: 5}).replace('-', kMinus);
  const factor = Number((value / 10 ** power).toPrecision(2));
  const raised = String(power).replace(/./g, (c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'['0123456789'.indexOf(c)] ?? '⁻');
  return `${factor === 1 ? '' : `${factor}·`}10${raised}`;
}

/// Ends of an axis: its own, else those of the numbers with a little room.
function ends(axis, values) {
  const finite = values.filter((v) => Number.isFinite(kScales[axis.scale].to(v)));
  const low = Math.min(...finite), high = Math.max(...finite);
  if (axis.scale === 'log') {
    const floor = axis.decades ? Math.max(low, high / 10 ** axis.decades) : low;
    const room = high < 2 * low ? 2 : 1.25;
    return [axis.low ?? floor / room, axis.high ?? high * room];
  }
  if (axis.scale === 'digits') return [axis.low ?? low ** 1.1, axis.high ?? high ** 0.9];
  return [axis.low ?? low, axis.high ?? (high > 0 ? high * 1.05 : 1)];
}

function chart_axis(axis, values, theme) {
  const [low, high] = finite_ends(axis, values);
  const {to} = kScales[axis.scale];
  return {
    type: 'linear',
    min: to(low),
    max: to(high),
    title: {display: true, text: axis.label, color: theme.muted, font: {size: 13}},
    grid: {color: theme.line, borderColor: theme.line, tickLength: 4},
    afterBuildTicks: (scale) => {
      const ticks = axis.ticks ?? kScales[axis.scale].ticks(low, high);
      scale.ticks = ticks.map((tick) => ({value: to(tick), label: tick_text(tick)}));
    },
    ticks: {color: theme.muted, autoSkip: true, autoSkipPadding: 12, maxRotation: 0,
      callback: function (value, index) { return this.ticks[index].label ?? ''; }},
  };
}

function finite_ends(axis, values) {
  const [low, high] = ends(axis, values);
  return Number.isFinite(low) && Number.isFinite(high) ? [low, high] : [axis.scale === 'log' ? 0.1 : 0, 1];
}

/// Whether a line of text at x, y is clear of those that were found clear before.
function free_places() {
  const taken = [];
  return (x, y, right, width) => {
    const box = {left: right ? x : x - width - 9, right: right ? x + width + 9 : x, y};
    const clear = taken.every((other) => box.left > other.right || box.right < other.left || Math.abs(box.y - other.y) > 13);
    if (clear) taken.push(box);
    return clear;
  };
}

/// Vertical dashed lines with a name, and names beside points.
const kAnnotations = {
  id: 'annotations',
  afterDatasetsDraw(chart, unused, {marks, theme}) {
    const {ctx, chartArea, scales} = chart;
    ctx.save();
    ctx.font = `12px ${getComputedStyle(document.body).fontFamily}`;
    ctx.fillStyle = ctx.strokeStyle = theme.muted;
    for (const mark of marks) {
      const x = scales.x.getPixelForValue(mark.x);
      ctx.setLineDash([3, 4]);
      ctx.beginPath();
      ctx.moveTo(x, chartArea.top);
      ctx.lineTo(x, chartArea.bottom);
      ctx.stroke();
      const right = x < (chartArea.left + chartArea.right) / 2;
      ctx.textAlign = right ? 'left' : 'right';
      ctx.fillText(mark.label, x + (right ? 6 : -6), chartArea.top + 12);
    }
    const free = free_places();
    chart.data.datasets.forEach((dataset, d) => dataset.data.forEach((point, n) => {
      if (!point.note) return;
      const at = chart.getDatasetMeta(d).data[n];
      const right = at.x < (chartArea.left + chartArea.right) / 2;
      const y = [-7, 15].map((down) => at.y + down).find((line) => free(at.x, line, right, ctx.measureText(point.note).width));
      if (y === undefined) return;
      ctx.fillStyle = theme.ink;
      ctx.textAlign = right ? 'left' : 'right';
      ctx.fillText(point.note, at.x + (right ? 9 : -9), y);
    }));
    ctx.restore();
  },
};

function theme_colours() {
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(name).trim();
  return {ink: colour('--ink'), muted: colour('--muted'), line: colour('--line'), raised: colour('--raised')};
}

const charts = new Map();  // by the name of the figure

/// The canvas and the table of values of a figure, made when it is first drawn.
function plot_parts(name) {
  const figure = document.querySelector(`figure[data-plot="${name}"]`);
  if (!figure.firstChild) {
    const canvas = make('canvas');
    canvas.setAttribute('role', 'img');
    const box = make('div', {className: 'scroll', tabIndex: 0, role: 'region', ariaLabel: 'Values of the plot'});
    const details = make('details', {}, make('summary', {}, 'Values as a table'), box);
    figure.append(make('div', {className: 'plot'}, canvas), make('figcaption'), details);
  }
  return {canvas: figure.querySelector('canvas'), caption: figure.querySelector('figcaption'),
    details: figure.querySelector('details')};
}

function value_table(details, plot) {
  const fill = () => {
    if (!details.open) return;
    const listed = plot.series.filter((series) => !series.drawn_only);
    const lines = listed.flatMap((series) => series.x.map((x, n) => make('tr', {},
      make('th', {scope: 'row', className: 'text'}, series.names?.[n] ?? series.label), make('td', {}, tick_text(x)),
      make('td', {}, Number.isFinite(series.y[n]) ? String(Number(series.y[n].toPrecision(4))) : '–'))));
    const head = ['', plot.x.label, plot.y.label].map((text) => make('th', {scope: 'col'}, text));
    details.lastChild.replaceChildren(make('table', {}, make('thead', {}, make('tr', {}, ...head)), make('tbody', {}, ...lines)));
  };
  details.ontoggle = fill;
  fill();
}

function dataset(series, plot, theme) {
  const to_x = kScales[plot.x.scale].to, to_y = kScales[plot.y.scale].to;
  return {
    label: series.label,
    data: series.x.map((x, n) => ({x: to_x(x), y: to_y(series.y[n]), at: [x, series.y[n]],
      name: series.names?.[n], note: series.notes?.[n]})),
    borderColor: series.colour,
    backgroundColor: series.fill ?? series.colour,
    borderWidth: series.width ?? 2,
    borderDash: series.dash ?? [],
    stepped: series.stepped ?? false,
    showLine: !series.points,
    pointStyle: series.shape ?? 'circle',
    pointRadius: series.points ?? 0,
    pointHoverRadius: (series.points ?? 2) + 2,
    pointBorderColor: series.border ?? theme.raised,
    pointBorderWidth: series.border ? 2 : series.points ? 1 : 0,
    order: series.order ?? 0,
  };
}

/// Draws plot = {x, y, series, marks, about, by_x} into the figure of this name; x, y: {label, scale, low, high, ticks}.
/// A series that is drawn_only is not in the table of values.
function draw_plot(name, plot) {
  const theme = theme_colours();
  const parts = plot_parts(name);
  const all = (axis) => plot.series.flatMap((series) => series[axis]);
  charts.get(name)?.destroy();
  charts.set(name, new Chart(parts.canvas, {
    type: 'scatter',
    data: {datasets: plot.series.map((series) => dataset(series, plot, theme))},
    plugins: [kAnnotations],
    options: {
      animation: false,
      responsive: true,
      maintainAspectRatio: false,
      interaction: plot.by_x ? {mode: 'x', intersect: false} : {mode: 'nearest', intersect: true},
      scales: {x: chart_axis(plot.x, all('x'), theme), y: chart_axis(plot.y, all('y'), theme)},
      plugins: {
        legend: {display: false},
        annotations: {theme, marks: (plot.marks ?? []).map((mark) => ({...mark, x: kScales[plot.x.scale].to(mark.x)}))},
        tooltip: {
          filter: (item, index, items) => items.findIndex((other) => other.datasetIndex === item.datasetIndex) === index,
          callbacks: {
            title: ([first]) => (plot.by_x && first ? `${plot.x.label.replace(/ \(.*/, '')} ${tick_text(first.raw.at[0])}` : ''),
            label: (item) => `${item.raw.name ?? item.dataset.label}: `
              + (plot.by_x ? tick_text(item.raw.at[1]) : item.raw.at.map(tick_text).join(', ')),
          },
        },
      },
    },
  }));
  parts.canvas.setAttribute('aria-label', plot.about);
  parts.caption.textContent = plot.caption ?? '';
  value_table(parts.details, plot);
}
