// The page of a fit of families to data.

const kColumns = {
  name: {heading: 'family', text: true},
  status: {heading: 'status', text: true, about: 'whether the search ended inside the domain, at its bound, or not at all'},
  theta: {heading: 'θ', digits: 4, about: 'the fitted parameters'},
  se: {heading: 'standard error', digits: 4, about: 'of each parameter, from the observed information'},
  tau: {heading: 'τ', digits: 4, about: 'Kendall’s τ of a pair under the fitted copula'},
  loglik: {heading: 'log-likelihood', digits: 2, better: 'higher', about: 'sum of ln c over the rows'},
  aic: {heading: 'AIC', digits: 2, better: 'lower', about: '2k − 2 log-likelihood, k parameters'},
  bic: {heading: 'BIC', digits: 2, better: 'lower', about: 'k ln n − 2 log-likelihood'},
};

const kTable = {
  columns: () => Object.keys(kColumns),
  rows: () => [...data.rows],
  peers: () => data.rows,
  caption: () => '',
};

const shown_rows = () => data.rows.filter((row) => chosen.colours.has(row.name));
const pair = () => data.pairs[Number(element('columns').value)];

/// A tick that is taken away takes no family out of the contours: those have a choice of their own.
const contour_row = () => data.rows.find((row) => row.name === element('family').value);

/// The density of a pair of columns, where that of the row is of the first two: a column reflected otherwise than they are
/// is read from its other end.
function density_of(row, [a, b]) {
  const turned = (column, k) => row.reflected[column] !== row.reflected[k];
  const rows = turned(a, 0) ? [...row.density].reverse() : row.density;
  return turned(b, 1) ? rows.map((line) => [...line].reverse()) : rows;
}

/// A line for a level: its pieces, with a gap after each.
function contour_series(density, level, colour) {
  const place = (node) => (node + 0.5) / density.length;
  const ends = contour(density, level);
  const numbers = (k) => ends.flatMap(([from, to]) => [place(from[k]), place(to[k]), NaN]);
  return {label: `density ${level}`, colour, width: level === 1 ? 3 : 1.25, drawn_only: true, x: numbers(0), y: numbers(1)};
}

function draw_pair() {
  const {columns: [a, b], tau} = pair();
  const row = contour_row();
  const theme = theme_colours();
  const unit = {scale: 'linear', low: 0, high: 1, ticks: [0, 0.2, 0.4, 0.6, 0.8, 1]};
  const points = {label: 'row', colour: theme.muted, points: 2, order: 1, x: data.points[a], y: data.points[b]};
  const colour = chosen.colours.get(row?.name) ?? theme.ink;
  const lines = row ? kLevels.map((level) => contour_series(density_of(row, [a, b]), level, colour)) : [];
  const what = `${data.columns[a]} and ${data.columns[b]}: Kendall’s τ ${show(tau, {digits: 3})}`;
  const count = data.points[a].length;
  const which = count === data.n ? `All ${count.toLocaleString('en')} rows.`
    : `${count.toLocaleString('en')} of ${data.n.toLocaleString('en')} rows, evenly spaced in the file.`;
  const fitted = row ? ` Contours of ${row.name} at ${kLevels.join(', ')}; the thick one is 1, independence.` : '';
  draw_plot('pair', {
    x: {label: data.columns[a], ...unit},
    y: {label: data.columns[b], ...unit},
    series: [...lines, points],
    about: `${what}.${fitted}`,
    caption: `${what}. ${which}${fitted}`,
  });
}

function draw_kendall() {
  const lambda = radio_value('kendall') === 'lambda';
  const value = (k) => k.map((one, n) => (lambda ? data.kendall_t[n] - one : one));
  const theme = theme_colours();
  const rows = shown_rows().filter((row) => row.kendall);
  const of_data = {label: 'data', colour: theme.ink, width: 4, order: 1, x: data.kendall_t, y: value(data.kendall)};
  const fitted = rows.map((row) =>
    ({label: row.name, colour: chosen.colours.get(row.name), x: data.kendall_t, y: value(row.kendall)}));
  const series = [of_data, ...fitted];
  const least = Math.min(...series.flatMap(({y}) => y));
  draw_plot('kendall', {
    x: {label: 't', scale: 'linear', low: 0, high: 1, ticks: [0, 0.2, 0.4, 0.6, 0.8, 1]},
    y: {label: lambda ? 'λ(t)' : 'K(t)', scale: 'linear', low: lambda ? 1.05 * least : 0, high: lambda ? 0 : 1},
    series,
    by_x: true,
    about: `Kendall distribution: ${series.map(({label}) => label).join('; ')}`,
    caption: 'Wide line: data. A family that is rotated or a mixture has the share among 20,000 of its points.',
  });
}

function draw_all() {
  const rows = shown_rows().map(({name}) => ({name, colour: chosen.colours.get(name)}));
  draw_chosen([{name: 'data', colour: theme_colours().ink, fixed: true}, ...rows]);
  draw_table();
  draw_pair();
  draw_kendall();
}

function start() {
  const pairs = data.pairs.map(({columns: [a, b]}, n) => [String(n), `${data.columns[a]}, ${data.columns[b]}`]);
  fill_select(element('columns'), pairs, '0');
  const fitted = data.rows.filter((row) => !row.error);
  fill_select(element('family'), fitted.filter((row) => row.density).map(({name}) => [name, name]));
  fitted.slice(0, 3).forEach((row) => choose(row.name, true));
  start_page(`${data.n.toLocaleString('en')} rows of ${data.columns.join(', ')}; margins: ${data.margins}; `
    + `method: ${data.method}. ${data.rows.length} families, the best first: ${data.rows[0].name}.`);
  start_table('aic');
  for (const id of ['columns', 'family']) element(id).onchange = draw_pair;
  for (const radio of document.querySelectorAll('input[name="kendall"]')) radio.onchange = draw_kendall;
  draw_all();
}

start();
