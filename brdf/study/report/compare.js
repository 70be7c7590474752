// The page as a whole: what is chosen at its head goes into every section.

function draw_plots() {
  draw_lobes();
  draw_cost();
  draw_albedo();
  draw_margins();
}

function draw_all() {
  draw_chosen(shown_models());
  draw_table();
  draw_plots();
}

function change_material() {
  chosen.material = element('material').value;
  fill_pictures();
  fill_live();
  fill_copula();
  draw_all();
  draw_pictures();
}

function summary() {
  const models = new Set(data.rows.map((row) => row.name)).size;
  const names = data.materials.map(({name, provenance}) => `${name} (${provenance})`).join(', ');
  return `${models} ${models === 1 ? 'model' : 'models'} on ${names}: fitted, measured and drawn by the same code.`;
}

function start() {
  start_page(summary(), data.machine);
  start_table('log1p_mae');
  document.title = `${data.materials.map(({name}) => name).join(', ')}: reflectance models compared`;
  fill_select(element('material'), data.materials.map(({name}) => [name, name]), chosen.material);
  const errors = measures.filter((name) => kColumns[name].better);
  fill_select(element('error'), errors.map((name) => [name, kColumns[name].heading]), 'log1p_mae');
  if (data.materials.length > 1) {
    const box = make('input', {type: 'checkbox', id: 'all-materials', onchange: draw_table});
    element('table-controls').prepend(make('label', {className: 'check'}, box, ' all materials'));
  }
  const slider = element('theta-i');
  Object.assign(slider, {min: 0, max: data.axes.lobe_theta_i.length - 1, step: 1});
  slider.value = data.axes.lobe_theta_i.indexOf(45);
  for (const row of rows_of(chosen.material).filter((row) => row.picture).sort(compare_rows).slice(0, 3)) {
    choose(row.name, true);
  }

  element('material').onchange = change_material;
  slider.oninput = draw_lobes;
  element('error').onchange = draw_cost;
  const redraw = {'lobe-scale': draw_lobes, cost: draw_cost, channel: draw_albedo};
  for (const [name, draw] of Object.entries(redraw)) {
    for (const radio of document.querySelectorAll(`input[name="${name}"]`)) radio.onchange = draw;
  }
  start_pictures();
  start_live();
  start_copula();
  change_material();
}

start();
