// The table of the page's rows, sorted by a heading. kTable is the page's: columns(), names in kColumns; rows(); peers(row),
// those among which the row may be the best; caption(rows). A row has a name; an error stands in place of its numbers.

const sorting = {by: '', direction: 1};

const is_text = (column) => Boolean(kColumns[column].text);

function sort_by(column) {
  if (sorting.by === column) {
    sorting.direction = -sorting.direction;
  } else {
    sorting.by = column;
    sorting.direction = kColumns[column].better === 'higher' ? -1 : 1;
  }
  draw_table();
  element('table').querySelector(`[data-column="${column}"]`).focus();
  element('status').textContent = `Sorted by ${kColumns[column].heading}, `
    + (sorting.direction > 0 ? 'smallest first' : 'largest first');
}

/// What a column sorts by and shows: of several numbers the first, and all.
const sort_key = (value) => number_of(Array.isArray(value) ? value[0] : value);
const cell_text = (value, measure) => [value].flat().map((one) => show(one, measure)).join(', ') || show(null);

function compare_rows(a, b) {
  if (is_text(sorting.by)) return sorting.direction * a[sorting.by].localeCompare(b[sorting.by], 'en', {numeric: true});
  const [x, y] = [a, b].map((row) => (row.error ? NaN : sort_key(row[sorting.by])));
  if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
  return x === y ? 0 : sorting.direction * (x < y ? -1 : 1);
}

function heading(column) {
  const {heading, about, unit} = kColumns[column];
  const button = make('button', {type: 'button', title: about ?? '', onclick: () => sort_by(column)}, heading);
  button.dataset.column = column;
  const cell = make('th', {scope: 'col', className: column === 'name' ? 'name' : is_text(column) ? 'text' : ''}, button);
  if (unit) cell.append(make('small', {}, unit));
  if (sorting.by === column) cell.setAttribute('aria-sort', sorting.direction > 0 ? 'ascending' : 'descending');
  return cell;
}

/// Whether none of its peers is better.
function is_best(row, column) {
  const better = kColumns[column].better;
  if (!better || Number.isNaN(number_of(row[column]))) return false;
  const sign = better === 'lower' ? 1 : -1;
  return kTable.peers(row).every((other) => !(sign * number_of(other[column]) < sign * number_of(row[column])));
}

function name_cell(row) {
  const box = make('input', {type: 'checkbox', checked: chosen.colours.has(row.name), disabled: Boolean(row.error)});
  box.setAttribute('aria-label', `${row.name} in the plots`);
  box.onchange = () => {
    choose(row.name, box.checked);
    draw_all();
    element('table').querySelector(`input[data-row="${box.dataset.row}"]`)?.focus();
  };
  box.dataset.row = data.rows.indexOf(row);
  const label = make('label', {title: row.note ?? ''}, box, row.name);
  return make('th', {scope: 'row', className: 'name'}, label);
}

function table_row(row) {
  const line = make('tr', {}, name_cell(row));
  const numbers = kTable.columns().filter((column) => !is_text(column));
  for (const column of kTable.columns().slice(1)) {
    if (row.error && !is_text(column)) {
      line.append(make('td', {className: 'failed', colSpan: numbers.length}, row.error));
      break;
    }
    const text = is_text(column) ? row[column] : cell_text(row[column], kColumns[column]);
    const best = column === 'choice' || (!is_text(column) && is_best(row, column));
    line.append(make('td', {className: [is_text(column) && 'text', best && 'best'].filter(Boolean).join(' ')}, text));
  }
  return line;
}

function draw_table() {
  const wanted = element('find').value.trim().toLowerCase();
  const rows = kTable.rows().filter((row) => row.name.toLowerCase().includes(wanted)).sort(compare_rows);
  const table = element('table');
  const count = `${rows.length} ${rows.length === 1 ? 'row' : 'rows'}.`;
  element('caption').replaceChildren(make('span', {}, `${kTable.caption()} ${count}`));
  table.tHead.replaceChildren(make('tr', {}, ...kTable.columns().map(heading)));
  table.tBodies[0].replaceChildren(...rows.map(table_row));
}

function start_table(by) {
  sorting.by = by;
  sorting.direction = kColumns[by].better === 'higher' ? -1 : 1;
  const explained = kTable.columns().filter((name) => kColumns[name].about);
  element('glossary').append(...explained.flatMap((name) =>
    [make('dt', {}, kColumns[name].heading), make('dd', {}, kColumns[name].about)]));
  element('find').oninput = draw_table;
}
