'use strict';
// The data of the page and what is chosen of it.

const data = JSON.parse(document.getElementById('data').textContent);
const element = (id) => document.getElementById(id);

/// What is counted or measured. Error measures have a better end; digits are decimals, unless the number is small.
const kMeasures = {
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

const kMinus = '\u2212';

/// A value as the table shows it; "inf" and "nan" come as text, null for none.
function show(value, measure = {digits: 4}) {
  if (value === null || value === undefined || value === 'nan') return '–';
  if (value === 'inf') return '∞';
  const small = value !== 0 && Math.abs(value) < 10 ** -measure.digits;
  const text = small ? value.toExponential(1) : value.toLocaleString('en', {
    minimumFractionDigits: measure.digits, maximumFractionDigits: measure.digits});
  return text.replace('-', kMinus);
}

/// For comparisons: what has no value sorts last, whichever way.
function number_of(value) {
  return value === 'inf' ? Infinity : typeof value === 'number' ? value : NaN;
}

/// A model's name is the same on all materials.
function name_of(row) {
  const name = row.mode ? `${row.mode} · ${row.family}` : row.model;
  return row.budget ? `${name} ≤ ${row.budget.toLocaleString('en')} B` : name;
}

for (const row of data.rows) row.name = name_of(row);
const measures = Object.keys(kMeasures).filter((name) => data.rows.some((row) => name in row));

/// Colours that people with a colour vision deficiency tell apart (Okabe and Ito).
const kSeries = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];

const chosen = {
  material: data.materials[0].name,
  colours: new Map(),  // of the models in the plots, by name
};

const rows_of = (material) => data.rows.filter((row) => row.material === material);
const material_of = (name) => data.materials.find((material) => material.name === name);
const current_material = () => material_of(chosen.material);

/// The reference and the chosen models as the plots draw them: name, colour, row (none for the reference), curves.
function shown_models() {
  const style = getComputedStyle(document.documentElement);
  const reference = {name: 'reference', colour: style.getPropertyValue('--ink'), curves: current_material().curves};
  const models = rows_of(chosen.material)
    .filter((row) => chosen.colours.has(row.name))
    .map((row) => ({name: row.name, colour: chosen.colours.get(row.name), row, curves: row.curves}));
  return [reference, ...models];
}

/// Shows a model in the plots, in place of the one chosen first where all colours are in use.
function choose(name, wanted) {
  chosen.colours.delete(name);
  if (!wanted) return;
  const free = () => kSeries.find((colour) => ![...chosen.colours.values()].includes(colour));
  if (!free()) chosen.colours.delete(chosen.colours.keys().next().value);
  chosen.colours.set(name, free());
}

function fill_select(select, options, value) {
  select.replaceChildren(...options.map(([key, label]) => new Option(label, key, false, key === value)));
}

/// An element with properties and children.
function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}
