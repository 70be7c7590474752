'use strict';
// The data of the page, its elements and numbers; what is shown in its plots.

const data = JSON.parse(document.getElementById('data').textContent);
const element = (id) => document.getElementById(id);
const radio_value = (name) => document.querySelector(`input[name="${name}"]:checked`).value;

/// An element with properties and children.
function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

function fill_select(select, options, value) {
  select.replaceChildren(...options.map(([key, label]) => new Option(label, key, false, key === value)));
}

const kMinus = '\u2212';

/// A value as the table shows it; "inf" and "nan" come as text, null for none.
function show(value, measure = {digits: 4}) {
  if (value === null || value === undefined || value === 'nan') return '–';
  if (value === 'inf' || value === '-inf') return value.replace('-', kMinus).replace('inf', '∞');
  if (value === 0) return '0';
  const small = Math.abs(value) < 10 ** -measure.digits;
  const text = small ? value.toExponential(1) : value.toLocaleString('en', {
    minimumFractionDigits: measure.digits, maximumFractionDigits: measure.digits});
  return text.replaceAll('-', kMinus);
}

/// For comparisons: what has no value sorts last, whichever way.
function number_of(value) {
  return value === 'inf' ? Infinity : value === '-inf' ? -Infinity : typeof value === 'number' ? value : NaN;
}

/// Colours that people with a colour vision deficiency tell apart (Okabe and Ito).
const kSeries = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];

const chosen = {
  colours: new Map(),  // of what the plots show, by name
};

/// Shows a name in the plots, in place of the one chosen first where all colours are in use.
function choose(name, wanted) {
  chosen.colours.delete(name);
  if (!wanted) return;
  const free = () => kSeries.find((colour) => ![...chosen.colours.values()].includes(colour));
  if (!free()) chosen.colours.delete(chosen.colours.keys().next().value);
  chosen.colours.set(name, free());
}

/// The list at the head of the page. @param shown entries {name, colour, fixed}; one that is fixed cannot be taken out.
function draw_chosen(shown) {
  const item = ({name, colour, fixed}) => {
    const swatch = make('span', {className: 'swatch'});
    swatch.style.setProperty('--series', colour);
    const entry = make('li', {}, swatch, name);
    if (!fixed) {
      const button = make('button', {type: 'button', onclick: () => { choose(name, false); draw_all(); }}, '×');
      button.setAttribute('aria-label', `Take ${name} out of the plots`);
      entry.append(button);
    }
    return entry;
  };
  element('chosen').replaceChildren(...shown.map(item));
}

/// What every page has at its head and foot. @param machine that measured its times, if it has any.
function start_page(summary, machine) {
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  element('summary').textContent = summary;
  element('machine').textContent = `${machine ? `Times of ${machine}. ` : ''}Loads nothing from a network.`;
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw_all);
}
