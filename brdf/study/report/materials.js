// The materials and models of a comparison, and what is chosen of them.

/// What is counted or measured. Error measures have a better end; digits are decimals, unless the number is small.
const kColumns = {
  name: {heading: 'model', text: true},
  material: {heading: 'material', text: true},
  kind: {heading: 'kind', text: true},
  bytes: {heading: 'size', unit: 'B', digits: 0, about: 'bytes of everything that evaluation needs'},
  eval_ns: {heading: 'time', unit: 'ns', digits: 0, about: 'an RGB value in a batch on one thread'},
  fit_s: {heading: 'fit', unit: 's', digits: 1, about: 'wall clock of the fit on all threads'},
  log1p_mae: {heading: 'log1p MAE', digits: 4, better: 'lower', about: 'mean |ln(1 + f cos) − ln(1 + g cos)|'},
  logrel_mae: {heading: 'log-relative MAE', digits: 4, better: 'lower', about: 'mean |ln((f w + 0.001) / (g w + 0.001))|'},
  cuberoot_rms: {heading: 'cube root RMS', digits: 4, better: 'lower', about: 'root mean square of the difference of cube roots of f cos'},
  rel_l2: {heading: 'relative L2', digits: 4, better: 'lower', about: 'root of the sum of squares of (f − g) cos over that of f cos'},
  sphere_psnr_linear_db: {heading: 'sphere PSNR', unit: 'dB', digits: 1, better: 'higher', about: 'of the sphere, linear values'},
  psnr_gamma_db: {heading: 'display PSNR', unit: 'dB', digits: 1, better: 'higher', about: 'of the sphere as displayed'},
  ssim: {heading: 'SSIM', digits: 4, better: 'higher', about: 'structural similarity of the sphere as displayed'},
  delta_e_2000: {heading: 'ΔE 2000', digits: 2, better: 'lower', about: 'mean colour difference of the sphere as displayed'},
  sampling_efficiency: {heading: 'sampling', digits: 3, about: 'efficiency of its own sampler; 1 is a perfect one'},
  reciprocity_error: {heading: 'reciprocity', digits: 4, about: 'mean |f(a, b) − f(b, a)| over mean |f|'},
  albedo_max: {heading: 'albedo', digits: 3, about: 'largest directional albedo; above 1 it would emit light'},
};

const kProvenance = {
  measured: 'measured',
  reconstruction: 'a reconstruction of measured reflectance, not a measurement',
  synthetic: 'synthetic: computed from formulas, not measured',
  unknown: 'of unknown origin',
};

/// A model's name is the same on all materials.
function name_of(row) {
  const name = row.mode ? `${row.mode} · ${row.family}` : row.model;
  return row.budget ? `${name} ≤ ${row.budget.toLocaleString('en')} B` : name;
}

for (const row of data.rows) row.name = name_of(row);
const measures = Object.keys(kColumns).filter((name) => !kColumns[name].text && data.rows.some((row) => name in row));

chosen.material = data.materials[0].name;

const rows_of = (material) => data.rows.filter((row) => row.material === material);
const current_material = () => data.materials.find(({name}) => name === chosen.material);

/// The reference and the chosen models as the plots draw them: name, colour, row (none for the reference), curves.
function shown_models() {
  const reference = {name: 'reference', colour: theme_colours().ink, fixed: true, curves: current_material().curves};
  const models = rows_of(chosen.material)
    .filter((row) => chosen.colours.has(row.name))
    .map((row) => ({name: row.name, colour: chosen.colours.get(row.name), row, curves: row.curves}));
  return [reference, ...models];
}

const all_materials = () => Boolean(element('all-materials')?.checked);

const kTable = {
  columns: () => ['name', ...(all_materials() ? ['material'] : []), ...(data.rows.some((row) => row.kind) ? ['kind'] : []),
    ...measures],
  rows: () => [...(all_materials() ? data.rows : rows_of(chosen.material))],
  peers: (row) => rows_of(row.material),
  caption: () => (all_materials() ? data.materials : [current_material()])
    .map(({name, provenance}) => `${name} is ${kProvenance[provenance]}.`).join(' '),
};
