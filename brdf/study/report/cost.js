// The page of error against cost.

const kind = kKinds[data.kind];
const kColumns = {...kind.columns, choice: {heading: 'choice', text: true, about: 'what the plot recommends'}};

data.rows.forEach((row) => Object.assign(row, {name: kind.name(row), choice: ''}));

const part_rows = () => data.rows.filter((row) => !kind.part || row[kind.part] === element('part').value);

const kTable = {
  columns: () => Object.keys(kColumns).filter((name) => name !== kind.part),
  rows: part_rows,
  caption: () => (kind.part ? `${element('part').value}.` : ''),
};

const series_names = () => [...new Set(part_rows().filter((row) => !row.error).map((row) => row.name))];
const label_of = (row) => `${row.name}, ${kind.detail(row)}`;
const unit_of = (name) => (kColumns[name].unit ? ` (${kColumns[name].unit})` : '');

/// The rows that can be drawn, as points of cost x and error y.
function points_of(cost, error) {
  return part_rows().map((row) => ({row, x: number_of(row[cost]), y: number_of(row[error])}))
    .filter(({x, y}) => x > 0 && y > 0 && Number.isFinite(y));
}

/// The cheapest whose error is at most the limit: of each name, or of all.
function recommended_rows(cost, error, limit) {
  const enough = part_rows().filter((row) => number_of(row[error]) <= limit && number_of(row[cost]) > 0);
  const cheapest = (rows) => rows.reduce((best, row) => (row[cost] < best[cost] ? row : best));
  if (kind.recommend === 'all') return enough.length > 0 ? [cheapest(enough)] : [];
  return series_names().map((name) => enough.filter((row) => row.name === name))
    .filter((rows) => rows.length > 0).map(cheapest);
}

/// The limits to choose from, and the first choice: those of the kind, else round numbers, twice the least error.
function limits(error) {
  if (kind.limits) return [kind.limits, kind.limit];
  const errors = points_of(kind.costs[0], error).map(({y}) => y);
  if (errors.length === 0) return [[1], 1];
  const [low, high] = [Math.min(...errors), Math.max(...errors)];
  const round = log_ticks(low, high * 1.001, [1, 2, 5]);
  const all = round.length > 0 ? round : [Number(high.toPrecision(2)) * 1.1];
  return [all, all.find((limit) => limit >= 2 * low) ?? all.at(-1)];
}

function fill_limits() {
  const [all, first] = limits(element('error').value);
  fill_select(element('limit'), all.map((limit) => [String(limit), tick_text(limit)]), String(first));
}

/// The points of a name, and the path through them.
function series_of(name, points, best, theme) {
  const own = points.filter(({row}) => row.name === name).sort((a, b) => a.x - b.x);
  const colour = chosen.colours.get(name) ?? theme.muted;
  const note = ({row}) => (kind.recommend === 'all' && best.includes(row) ? label_of(row) : '');
  const xy = {x: own.map(({x}) => x), y: own.map(({y}) => y)};
  const shape = own.map(({row}) => kind.shapes?.[kind.detail(row)] ?? 'circle');
  const series = {label: name, colour, points: 6, shape, names: own.map(({row}) => label_of(row)), notes: own.map(note), ...xy};
  const joined = kind.join === 'name' && chosen.colours.has(name);
  return joined ? [series, {label: name, colour, width: 1.5, order: 1, drawn_only: true, ...xy}] : [series];
}

/// The line of those that no other beats, as steps.
function front_series(points, theme) {
  const best = front(points);
  return {label: 'best', colour: theme.muted, width: 1, order: 2, dash: [2, 3], stepped: 'before', drawn_only: true,
    x: best.map(({x}) => x), y: best.map(({y}) => y)};
}

/// From the first point of the first name on: the error over the root of the cost.
function guide_series(points, theme) {
  const own = points.filter(({row}) => row.name === series_names()[0]).sort((a, b) => a.x - b.x);
  const x = own.map((point) => point.x);
  return {label: 'root', colour: theme.muted, width: 1, order: 2, dash: [4, 4], drawn_only: true,
    x, y: x.map((cost) => own[0].y * Math.sqrt(x[0] / cost))};
}

function draw_cost() {
  const cost = element('cost-measure').value, error = element('error').value;
  const theme = theme_colours();
  const points = points_of(cost, error);
  const best = data.rows.filter((row) => row.choice);
  const marked = points.filter(({row}) => row.choice && chosen.colours.has(row.name));
  const rings = {label: 'recommended', colour: theme.ink, fill: 'transparent', border: theme.ink, points: 10, order: -1,
    drawn_only: true, x: marked.map(({x}) => x), y: marked.map(({y}) => y)};
  draw_plot('cost', {
    x: {label: kColumns[cost].heading + unit_of(cost), scale: 'log'},
    y: {label: kColumns[error].heading, scale: kind.scale},
    series: [rings, ...series_names().flatMap((name) => series_of(name, points, best, theme)),
      ...(kind.join === 'best' ? [front_series(points, theme)] : []),
      ...(kind.guide ? [guide_series(points, theme)] : [])],
    about: `${kColumns[error].heading} against ${kColumns[cost].heading}. ${element('recommended').textContent}`,
    caption: `${kind.drawn}A ring marks what is recommended.`,
  });
}

function mark_recommended() {
  const [cost, error, limit] = ['cost-measure', 'error', 'limit'].map((id) => element(id).value);
  const best = recommended_rows(cost, error, Number(limit));
  for (const row of data.rows) row.choice = best.includes(row) ? 'recommended' : '';
  const unit = kColumns[cost].unit ?? kColumns[cost].heading;
  const text = (row) => `${label_of(row)} (${tick_text(row[cost])} ${unit}, ${tick_text(row[error])})`;
  const asked = `whose ${kColumns[error].heading} is at most ${tick_text(Number(limit))}`;
  element('recommended').textContent = best.length === 0 ? `There is none ${asked}.`
    : `Recommended, the cheapest ${asked}: ${best.map(text).join('; ')}.`;
}

function draw_all() {
  mark_recommended();
  const shown = series_names().filter((name) => chosen.colours.has(name));
  draw_chosen(shown.map((name) => ({name, colour: chosen.colours.get(name)})));
  draw_table();
  draw_cost();
}

function start() {
  const values = kind.part ? [...new Set(data.rows.map((row) => row[kind.part]))] : [];
  element('part-label').hidden = values.length === 0;
  element('part-label').querySelector('span').textContent = kind.part ? kColumns[kind.part].heading : '';
  fill_select(element('part'), values.map((value) => [value, value]), values[0]);
  const options = (names) => names.map((name) => [name, kColumns[name].heading]);
  fill_select(element('cost-measure'), options(kind.costs), kind.costs[0]);
  const errors = kind.errors.filter((name) => data.rows.some((row) => number_of(row[name]) > 0));
  fill_select(element('error'), options(errors), errors[0]);
  fill_limits();
  element('cost-note').textContent = kind.about;
  start_page(kind.summary(), data.machine);
  element('pictures').hidden = !data.picture;
  if (data.picture) element('picture').src = data.picture;
  start_table(kind.costs[0]);
  series_names().slice(0, kSeries.length).forEach((name) => choose(name, true));
  for (const id of ['part', 'cost-measure', 'limit']) element(id).onchange = draw_all;
  element('error').onchange = () => { fill_limits(); draw_all(); };
  draw_all();
}

start();
