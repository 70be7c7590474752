// Two pictures of the sphere: side by side under a slider, or their difference.

const picture_names = () => ['reference', ...rows_of(chosen.material).filter((row) => row.picture).map((row) => row.name)];

function picture_of(name) {
  return name === 'reference' ? current_material().picture
    : rows_of(chosen.material).find((row) => row.name === name).picture;
}

const picture_view = () => document.querySelector('input[name="view"]:checked').value;

async function pixels_of(url) {
  const image = new Image();
  image.src = url;
  await image.decode();
  const canvas = make('canvas', {width: image.naturalWidth, height: image.naturalHeight});
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

function put(canvas, pixels, label) {
  canvas.width = pixels.width;
  canvas.height = pixels.height;
  canvas.getContext('2d').putImageData(pixels, 0, 0);
  canvas.setAttribute('aria-label', label);
}

/// The mean absolute difference of a pixel's displayed values, 0 to 1, at byte n.
const difference_at = (a, b, n) =>
  (Math.abs(a[n] - b[n]) + Math.abs(a[n + 1] - b[n + 1]) + Math.abs(a[n + 2] - b[n + 2])) / 765;

function difference(left, right, gain, false_colour) {
  const result = new ImageData(left.width, left.height);
  for (let n = 0; n < result.data.length; n += 4) {
    const share = Math.min(1, gain * difference_at(left.data, right.data, n));
    const colour = false_colour ? data.colour_map[Math.round(255 * share)]
      : [0, 1, 2].map((c) => gain * Math.abs(left.data[n + c] - right.data[n + c]));
    result.data.set([...colour, 255], n);
  }
  return result;
}

function mean_difference(left, right) {
  let sum = 0;
  for (let n = 0; n < left.data.length; n += 4) sum += difference_at(left.data, right.data, n);
  return sum / (left.data.length / 4);
}

function set_split(percent) {
  element('split').value = percent;
  element('compare').style.setProperty('--split', `${percent}%`);
}

let picture_turn = 0;  // a later choice wins over a slower decode

async function draw_pictures() {
  const turn = ++picture_turn;
  const names = [element('left').value, element('right').value];
  const [left, right] = await Promise.all(names.map((name) => pixels_of(picture_of(name))));
  if (turn !== picture_turn) return;
  const view = picture_view();
  const split = view === 'split';
  const gain = Number(element('gain').value);
  element('compare').classList.toggle('whole', !split);
  element('split').hidden = !split;
  element('gain-label').hidden = split;
  element('colour-bar').hidden = view !== 'false_colour';
  element('colour-bar-end').textContent = `${1 / gain} difference of displayed values`;
  if (split) {
    put(element('picture-left'), left, `Sphere, ${names[0]}`);
    put(element('picture-right'), right, `Sphere, ${names[1]}`);
  } else {
    put(element('picture-right'), difference(left, right, gain, view === 'false_colour'),
      `Difference of ${names[0]} and ${names[1]}, times ${gain}`);
  }
  element('picture-caption').textContent = (split ? `Left: ${names[0]}. Right: ${names[1]}.` : `${names[0]} and ${names[1]}.`)
    + ` Mean difference of displayed values: ${show(100 * mean_difference(left, right), {digits: 2})} %.`;
}

/// The names of the material; keeps what is chosen where the material has it.
function fill_pictures() {
  const names = picture_names();
  const keep = (id, fallback) => {
    const old = element(id).value;
    fill_select(element(id), names.map((name) => [name, name]), names.includes(old) ? old : fallback);
  };
  const best = rows_of(chosen.material).filter((row) => row.picture).sort(compare_rows)[0];
  keep('left', 'reference');
  keep('right', best ? best.name : 'reference');
}

function paint_colour_bar(canvas) {
  const bar = canvas.getContext('2d');
  data.colour_map.forEach(([r, g, b], n) => {
    bar.fillStyle = `rgb(${r} ${g} ${b})`;
    bar.fillRect(n, 0, 1, 1);
  });
}

function start_pictures() {
  paint_colour_bar(element('colour-bar').querySelector('canvas'));
  for (const id of ['left', 'right', 'gain']) element(id).onchange = draw_pictures;
  for (const radio of document.querySelectorAll('input[name="view"]')) radio.onchange = draw_pictures;
  element('split').oninput = (event) => set_split(event.target.value);
  const drag = (event) => {
    if (event.type === 'pointermove' && event.buttons === 0) return;
    const box = element('compare').getBoundingClientRect();
    set_split(Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width)));
  };
  element('compare').addEventListener('pointerdown', drag);
  element('compare').addEventListener('pointermove', drag);
}
