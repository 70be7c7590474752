// The table: sorted by a heading, of one material or all.

const sorting = {by: 'log1p_mae', direction: 1};

const is_text = (column) => column === 'material' || column === 'name' || column === 'kind';

function columns() {
  const text = ['name'];
  if (element('all-materials').checked) text.push('material');
  if (data.rows.some((row) => row.kind)) text.push('kind');
  return [...text, ...measures];
}

function sort_by(column) {
  if (sorting.by === column) {
    sorting.direction = -sorting.direction;
  } else {
    sorting.by = column;
    sorting.direction = kMeasures[column]?.better === 'higher' ? -1 : 1;
  }
  draw_table();
  element('table').querySelector(`[data-column="${column}"]`).focus();
  element('status').textContent = `Sorted by ${kMeasures[column]?.heading ?? column}, `
    + (sorting.direction > 0 ? 'smallest first' : 'largest first');
}

function compare_rows(a, b) {
  if (is_text(sorting.by)) return sorting.direction * a[sorting.by].localeCompare(b[sorting.by], 'en', {numeric: true});
  const x = number_of(a[sorting.by]), y = number_of(b[sorting.by]);
  if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
  return x === y ? 0 : sorting.direction * (x < y ? -1 : 1);
}

function heading(column) {
  const measure = kMeasures[column];
  const title = measure?.heading ?? {name: 'model'}[column] ?? column;
  const button = make('button', {type: 'button', title: measure?.about ?? '', onclick: () => sort_by(column)}, title);
  button.dataset.column = column;
  const cell = make('th', {scope: 'col', className: column === 'name' ? 'name' : is_text(column) ? 'text' : ''}, button);
  if (measure?.unit) cell.append(make('small', {}, measure.unit));
  if (sorting.by === column) cell.setAttribute('aria-sort', sorting.direction > 0 ? 'ascending' : 'descending');
  return cell;
}

/// Whether no other model of the material is better.
function is_best(row, column) {
  const better = kMeasures[column].better;
  if (!better || Number.isNaN(number_of(row[column]))) return false;
  const sign = better === 'lower' ? 1 : -1;
  return rows_of(row.material).every((other) => !(sign * number_of(other[column]) < sign * number_of(row[column])));
}

function name_cell(row) {
  const box = make('input', {type: 'checkbox', checked: chosen.colours.has(row.name), disabled: Boolean(row.error)});
  box.setAttribute('aria-label', `${row.name} in the plots`);
  box.onchange = () => {
    choose(row.name, box.checked);
    draw_all();
    [...element('table').querySelectorAll('input')].find((other) => other.dataset.key === box.dataset.key)?.focus();
  };
  box.dataset.key = `${row.material}\n${row.name}`;
  const label = make('label', {title: row.note ?? ''}, box, row.name);
  return make('th', {scope: 'row', className: 'name'}, label);
}

function table_row(row) {
  const line = make('tr', {}, name_cell(row));
  for (const column of columns().slice(1)) {
    if (row.error && !is_text(column)) {
      line.append(make('td', {className: 'failed', colSpan: measures.length}, row.error));
      break;
    }
    const text = is_text(column) ? row[column] : show(row[column], kMeasures[column]);
    const best = !is_text(column) && is_best(row, column);
    line.append(make('td', {className: is_text(column) ? 'text' : best ? 'best' : ''}, text));
  }
  return line;
}

/// What the numbers are about: a sentence for each material.
function caption(materials) {
  return materials.map(({name, provenance}) => `${name} is ${kProvenance[provenance]}.`).join(' ');
}

function draw_table() {
  const all = element('all-materials').checked;
  const wanted = element('find').value.trim().toLowerCase();
  const rows = (all ? data.rows : rows_of(chosen.material))
    .filter((row) => row.name.toLowerCase().includes(wanted)).sort(compare_rows);
  const table = element('table');
  element('caption').replaceChildren(make('span', {}, caption(all ? data.materials : [current_material()])
    + ` ${rows.length} ${rows.length === 1 ? 'row' : 'rows'}.`));
  table.tHead.replaceChildren(make('tr', {}, ...columns().map(heading)));
  table.tBodies[0].replaceChildren(...rows.map(table_row));
}
