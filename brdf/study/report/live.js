// The live sphere: a fitted model evaluated in WebGL from its own numbers, by the code that the library exports.

const live = {gl: null, program: null, row: null, angles: null};
const kLiveAngles = ['lamp-x', 'lamp-y', 'view-x', 'view-y'];  // degrees: to the right, up

const live_rows = () => rows_of(chosen.material).filter((row) => row.curves?.live);

function floats_of(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({length: bytes.length / 4}, (unused, n) => view.getFloat32(4 * n, true));
}

function compiled(gl, type, text) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function linked(gl, model) {
  const corners = '#version 300 es\nvoid main() { gl_Position = vec4(4 * (gl_VertexID % 2) - 1, 4 * (gl_VertexID / 2) - 1, 0, 1); }';
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, corners));
  gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER,
    element('sphere-shader').textContent.trim().replace('// MODEL', () => model.glsl)));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

function texture(gl, unit, width, height, internal_format, format, numbers) {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, internal_format, width, height, 0, format, gl.FLOAT, numbers);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
}

/// Textures of the model's numbers and of its albedo.
function load_numbers(gl, row) {
  const kAcross = 1024;
  const values = floats_of(row.curves.live.values);
  const rows = Math.ceil(values.length / kAcross);
  const padded = new Float32Array(rows * kAcross);
  padded.set(values);
  texture(gl, 0, kAcross, rows, gl.R32F, gl.RED, padded);
  const albedo = row.curves.albedo;
  texture(gl, 1, albedo[0].length, 1, gl.RGBA32F, gl.RGBA,
    Float32Array.from({length: 4 * albedo[0].length}, (unused, n) => albedo[n % 4]?.[n >> 2] ?? 1));
}

/// From the world to the frame of a viewer at these angles, column after column.
function view_matrix(right, up) {
  const [a, b] = [right, up].map((angle) => angle * Math.PI / 180);
  const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
  return [ca, -sa * sb, sa * cb, 0, cb, sb, -sa, -ca * sb, ca * cb];
}

function toward(right, up) {
  const [a, b] = [right, up].map((angle) => angle * Math.PI / 180);
  return [Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b)];
}

const times = (m, v) => [0, 1, 2].map((i) => m[i] * v[0] + m[3 + i] * v[1] + m[6 + i] * v[2]);

/// Draws size x size pixels for what the controls say. lines: meridians, soft: a smooth edge; 0 or 1.
function render_live(size, lines, soft) {
  const {gl, program} = live;
  const scene = live.row.curves.live;
  const [lamp_x, lamp_y, view_x, view_y] = kLiveAngles.map((id) => live.angles[id]);
  const view = view_matrix(view_x, view_y);
  gl.canvas.width = gl.canvas.height = size;
  gl.viewport(0, 0, size, size);
  gl.useProgram(program);
  const at = (name) => gl.getUniformLocation(program, name);
  gl.uniform1i(at('values'), 0);
  gl.uniform1i(at('albedo'), 1);
  gl.uniformMatrix3fv(at('view'), false, view);
  gl.uniform3fv(at('light'), times(view, toward(lamp_x, lamp_y)));
  gl.uniform3fv(at('irradiance'), scene.irradiance);
  gl.uniform3fv(at('background'), scene.background);
  for (const [name, value] of Object.entries({sky: Number(element('sky').value), exposure: scene.exposure,
    radius: scene.radius, size, lines, soft})) gl.uniform1f(at(name), value);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

/// The mean difference of displayed values from the picture of the C++ evaluation, over the sphere, 0 to 1.
async function difference_from_picture() {
  const scene = live.row.curves.live;
  const expected = await pixels_of(scene.picture);
  const size = expected.width;
  render_live(size, 0, 0);
  const found = new Uint8Array(4 * size * size);
  live.gl.readPixels(0, 0, size, size, live.gl.RGBA, live.gl.UNSIGNED_BYTE, found);
  let sum = 0, count = 0;
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      if (Math.hypot(2 * x + 1 - size, 2 * y + 1 - size) > scene.radius * size) continue;
      const a = 4 * ((size - 1 - y) * size + x), b = 4 * (y * size + x);  // WebGL's rows begin below
      for (let c = 0; c < 3; ++c) sum += Math.abs(found[a + c] - expected.data[b + c]) / 765;
      ++count;
    }
  }
  return sum / count;
}

function draw_live() {
  if (!live.program) return;
  for (const id of kLiveAngles) {
    live.angles[id] = Number(element(id).value);
    element(id).setAttribute('aria-valuetext', `${live.angles[id]} degrees`);
  }
  const side = element('live-canvas').clientWidth * Math.min(2, devicePixelRatio);
  render_live(Math.round(side) || 256, radio_value('drag') === 'view' ? 1 : 0, 1);
}

/// The lamp, the view and the sky of the scene in which the C++ evaluation drew its picture.
function reset_live() {
  const scene = live.row.curves.live;
  const [x, y, z] = scene.light;
  live.angles = {'lamp-x': Math.atan2(x, z) * 180 / Math.PI, 'lamp-y': Math.asin(y) * 180 / Math.PI, 'view-x': 0, 'view-y': 0};
  for (const id of kLiveAngles) element(id).value = live.angles[id];
  element('sky').value = scene.sky;
}

async function load_live() {
  live.row = live_rows().find((row) => row.name === element('live-model').value);
  live.program = null;
  reset_live();
  const gl = live.gl;
  if (!gl) return;
  load_numbers(gl, live.row);
  live.program = linked(gl, live.row.curves.live);
  const difference = await difference_from_picture();
  element('live').dataset.difference = difference;
  element('live-caption').textContent = `${live.row.name}, ${live.row.bytes.toLocaleString('en')} bytes, evaluated here. In the `
    + `first view the mean difference from the C++ evaluation is ${show(100 * difference, {digits: 3})} % of the displayed range.`;
  draw_live();
}

/// Fills the section for the material; hides it where no model can be evaluated here.
function fill_live() {
  const rows = live_rows();
  element('live').hidden = rows.length === 0;
  if (rows.length === 0) return;
  fill_select(element('live-model'), rows.map(({name}) => [name, name]), rows[0].name);
  load_live();
}

function move_live(right, up) {
  const what = radio_value('drag');
  element(`${what}-x`).value = (live.angles[`${what}-x`] + right + 540) % 360 - 180;
  element(`${what}-y`).value = live.angles[`${what}-y`] + up;
  draw_live();
}

function start_live() {
  const canvas = element('live-canvas');
  live.gl = canvas.getContext('webgl2', {antialias: false, preserveDrawingBuffer: true});
  if (!live.gl) element('live-caption').textContent = 'This browser has no WebGL 2, so there is no live sphere.';
  for (const id of [...kLiveAngles, 'sky']) element(id).oninput = draw_live;
  for (const radio of document.querySelectorAll('input[name="drag"]')) radio.onchange = draw_live;
  element('live-model').onchange = load_live;
  element('live-reset').onclick = () => { reset_live(); draw_live(); };
  canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons === 0) return;
    const degrees = radio_value('drag') === 'view' ? -0.5 : 0.5;  // a pixel; the sphere follows the hand
    move_live(degrees * event.movementX, -degrees * event.movementY);
  });
  canvas.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5]}[event.key];
    if (!step) return;
    event.preventDefault();
    move_live(...step);
  });
  new ResizeObserver(draw_live).observe(canvas);
}
