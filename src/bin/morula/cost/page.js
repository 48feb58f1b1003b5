"use strict";
const root = document.documentElement;
window.addEventListener("error", (e) => { root.dataset.error = e.message; });
const data = JSON.parse(document.getElementById("data").textContent);
const at = (id) => document.getElementById(id);
const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const state = { line: 0, index: 0 };
const line = () => data.lines[state.line];
const point = () => line().points[state.index];

// ---- figures ----

const short = (x, digits = 3) =>
  x === null || x === undefined ? "–" : Number(x.toPrecision(digits)).toLocaleString("en", { maximumFractionDigits: 8 });
const FIGURES = [
  ["spheres", (p) => p.n === p.asked ? p.n : `${p.n} of ${p.asked}`, ""],
  ["mismatch D", (p) => p.D.toFixed(4), ""],
  ["coverage", (p) => (100 * p.coverage).toFixed(2), "%"],
  ["overshoot", (p) => (100 * p.overshoot).toFixed(2), "%"],
  ["surface error (RMS)", (p) => (100 * p.surface_deq).toFixed(3), "% of d_eq"],
  ["roughness (RMS)", (p) => (p.roughness_rad * 180 / Math.PI).toFixed(1), "degrees"],
  ["inertia error, corrected", (p) => short(100 * p.inertia, 2), "%"],
  ["generation", (p) => short(1e3 * p.seconds), "ms"],
  ["time step", (p) => p.step_factor.toFixed(3), "of a sphere's"],
  ["cost of a step", (p) => short(p.step_cost), "of a sphere's"],
  ["cost of simulated time", (p) => short(p.time_cost), "of a sphere's"],
];

function showFigures() {
  const rows = FIGURES.map(([name, value, unit]) => `<tr><td>${name}</td><td>${value(point())}</td><td>${unit}</td></tr>`);
  at("figures").innerHTML = rows.join("");
  at("named").textContent = `${line().name}, ${point().n} sphere${point().n === 1 ? "" : "s"}, D ${point().D.toFixed(4)}`;
  at("why").textContent = line().why.charAt(0).toUpperCase() + line().why.slice(1) + ".";
  at("take").style.display = line().choice === null ? "none" : "";
  const slider = at("n");
  slider.max = line().points.length - 1;
  slider.value = state.index;
  at("line").value = state.line;
}

// ---- charts ----

const CHARTS = [
  ["spheres", (p) => p.n],
  ["generation time, ms", (p) => 1e3 * p.seconds],
  ["cost of a solver's step, over one with single spheres", (p) => p.step_cost],
];
const LEFT = 50, RIGHT = 10, TOP = 10, BOTTOM = 40;

function range(values) {
  const some = values.filter((v) => v > 0 && isFinite(v));
  if (!some.length) return [0.1, 1];
  return [Math.min(...some) / 1.25, Math.max(...some) * 1.25];
}

function ticks([low, high]) {
  const decades = Math.log10(high / low);
  const steps = decades > 3 ? [1] : decades > 1.2 ? [1, 2, 5] : [1, 2, 3, 4, 5, 6, 8];
  const all = [];
  for (let k = Math.floor(Math.log10(low)); k <= Math.log10(high); k++)
    for (const s of steps) {
      const v = s * 10 ** k;
      if (v >= low * 0.999 && v <= high * 1.001) all.push(v);
    }
  return all;
}

function drawChart(i) {
  const [title, of] = CHARTS[i];
  const box = at(`chart${i}`);
  const [w, h] = [box.clientWidth, box.clientHeight];
  const points = data.lines.flatMap((l) => l.points);
  const marks = i === 0 ? data.papers : [];
  const across = range(points.map(of).concat(marks.map((m) => m.n)));
  const up = range(points.map((p) => p.D).concat(marks.map((m) => m.D)));
  const x = (v) => LEFT + (w - LEFT - RIGHT) * Math.log(v / across[0]) / Math.log(across[1] / across[0]);
  const y = (v) => h - BOTTOM - (h - TOP - BOTTOM) * Math.log(Math.max(v, 1e-9) / up[0]) / Math.log(up[1] / up[0]);
  let svg = `<svg viewBox="0 0 ${w} ${h}">`;
  for (const t of ticks(across))
    svg += `<line x1="${x(t)}" x2="${x(t)}" y1="${TOP}" y2="${h - BOTTOM}" stroke="#e8e8e6"/>` +
      `<text class="tick" x="${x(t)}" y="${h - BOTTOM + 16}" text-anchor="middle">${short(t)}</text>`;
  for (const t of ticks(up))
    svg += `<line x1="${LEFT}" x2="${w - RIGHT}" y1="${y(t)}" y2="${y(t)}" stroke="#e8e8e6"/>` +
      `<text class="tick" x="${LEFT - 6}" y="${y(t) + 4}" text-anchor="end">${short(t)}</text>`;
  svg += `<path d="M${LEFT} ${TOP}V${h - BOTTOM}H${w - RIGHT}" fill="none" stroke="#8a8e96"/>` +
    `<text x="${(LEFT + w - RIGHT) / 2}" y="${h - 6}" text-anchor="middle">${title}</text>` +
    `<text x="12" y="${(h - BOTTOM + TOP) / 2}" text-anchor="middle" transform="rotate(-90 12 ${(h - BOTTOM + TOP) / 2})">mismatch D</text>`;
  data.lines.forEach((l, k) => {
    const path = l.points.map((p) => `${x(of(p)).toFixed(1)} ${y(p.D).toFixed(1)}`).join("L");
    const wide = k === state.line ? 3 : 1.5;
    svg += `<path d="M${path}" fill="none" stroke="${l.colour}" stroke-width="${wide}" stroke-linejoin="round"/>`;
    for (const p of l.points) svg += `<circle cx="${x(of(p))}" cy="${y(p.D)}" r="${wide + 0.5}" fill="${l.colour}"/>`;
  });
  for (const m of marks) {
    const [a, b] = [x(m.n), y(m.D)];
    svg += `<path d="M${a - 5} ${b - 5}l10 10m0 -10l-10 10" stroke="#000" stroke-width="2"/>`;
  }
  const [a, b] = [x(of(point())), y(point().D)];
  svg += `<circle cx="${a}" cy="${b}" r="7.5" fill="none" stroke="#000" stroke-width="2"/></svg>`;
  box.innerHTML = svg;
  box.onclick = (e) => {
    const from = box.getBoundingClientRect();
    let best = [Infinity, 0, 0];
    data.lines.forEach((l, k) => l.points.forEach((p, j) => {
      const d = (x(of(p)) - e.clientX + from.left) ** 2 + (y(p.D) - e.clientY + from.top) ** 2;
      if (d < best[0]) best = [d, k, j];
    }));
    select(best[1], best[2]);
  };
}

// ---- target and clump ----

const view = at("view");
const gl = view.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
let turn = [1, 0, 0, 0];
let zoom = 1;
const times = ([a, b, c, d], [e, f, g, h]) =>
  [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
const about = ([x, y, z], angle) => [Math.cos(angle / 2), ...[x, y, z].map((v) => v * Math.sin(angle / 2))];
turn = times(about([1, 0, 0], -1.1), about([0, 0, 1], -0.6));

const MESH = [`#version 300 es
in vec3 corner; in vec3 normal;
uniform mat3 turn; uniform vec3 low, edge, centre; uniform float scale; uniform vec2 fit;
out vec3 n;
void main() {
  vec3 p = turn * ((low + corner * edge - centre) * scale);
  n = turn * normal;
  gl_Position = vec4(p.xy * fit, -0.4 * p.z, 1.0);
}`, `#version 300 es
precision highp float;
in vec3 n; uniform vec3 tint; out vec4 colour;
void main() {
  vec3 m = normalize(n);
  float light = 0.34 + 0.66 * max(dot(m, normalize(vec3(-0.4, 0.5, 0.8))), 0.0) + 0.1 * max(-m.z, 0.0);
  colour = vec4(tint * light, 1.0);
}`];
// Each sphere is a square that faces the viewer; the fragment finds where its ray meets the sphere.
const BALL = [`#version 300 es
in vec2 square; in vec4 sphere; in float shade;
uniform mat3 turn; uniform vec3 centre; uniform float scale; uniform vec2 fit;
out vec2 q; out float middle, radius, tone;
void main() {
  vec3 c = turn * ((sphere.xyz - centre) * scale);
  radius = sphere.w * scale;
  middle = c.z; q = square; tone = shade;
  gl_Position = vec4((c.xy + square * radius) * fit, -0.4 * c.z, 1.0);
}`, `#version 300 es
precision highp float;
in vec2 q; in float middle, radius, tone;
uniform vec3 tint; out vec4 colour;
void main() {
  float left = 1.0 - dot(q, q);
  if (left < 0.0) discard;
  vec3 n = vec3(q, sqrt(left));
  gl_FragDepth = 0.5 - 0.2 * (middle + radius * n.z);
  float light = 0.34 + 0.66 * max(dot(n, normalize(vec3(-0.4, 0.5, 0.8))), 0.0);
  colour = vec4(mix(tint, vec3(1.0), tone) * light, 1.0);
}`];

function program([vertex, fragment]) {
  const made = gl.createProgram();
  [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]].forEach(([kind, text]) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  });
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  return made;
}

function attribute(of, name, values, size, kind, each = 0) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
  const place = gl.getAttribLocation(of, name);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, size, kind, kind !== gl.FLOAT, 0, 0);
  gl.vertexAttribDivisor(place, each);
  return buffer;
}

let scene = null;
function build() {
  const mesh = data.mesh;
  const target = program(MESH), balls = program(BALL);
  const targetArray = gl.createVertexArray();
  gl.bindVertexArray(targetArray);
  attribute(target, "corner", new Uint16Array(bytes(mesh.corners).buffer), 3, gl.UNSIGNED_SHORT);
  attribute(target, "normal", new Int8Array(bytes(mesh.normals).buffer), 3, gl.BYTE);
  const ballsArray = gl.createVertexArray();
  gl.bindVertexArray(ballsArray);
  attribute(balls, "square", new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), 2, gl.FLOAT);
  const spheres = attribute(balls, "sphere", new Float32Array(4), 4, gl.FLOAT, 1);
  const shades = attribute(balls, "shade", new Float32Array(1), 1, gl.FLOAT, 1);
  gl.bindVertexArray(null);
  const centre = mesh.low.map((v, a) => v + mesh.edge[a] / 2);
  const scale = 2.2 / Math.hypot(...mesh.edge);
  scene = { mesh, target, balls, targetArray, ballsArray, spheres, shades, centre, scale, count: 0 };
}

function load() {
  if (!scene) return;
  const spheres = new Float32Array(bytes(line().clumps[state.index]).buffer);
  scene.count = spheres.length / 4;
  // Neighbours in the list differ a little, so that spheres are told apart.
  const shades = Float32Array.from({ length: scene.count }, (_, i) => 0.32 * ((i * 0.618034) % 1));
  gl.bindBuffer(gl.ARRAY_BUFFER, scene.spheres);
  gl.bufferData(gl.ARRAY_BUFFER, spheres, gl.DYNAMIC_DRAW);
  gl.bindBuffer(gl.ARRAY_BUFFER, scene.shades);
  gl.bufferData(gl.ARRAY_BUFFER, shades, gl.DYNAMIC_DRAW);
}

function matrix() {
  const [w, x, y, z] = turn;
  return [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
}

function common(of, fit, tint) {
  gl.useProgram(of);
  const place = (name) => gl.getUniformLocation(of, name);
  gl.uniformMatrix3fv(place("turn"), false, matrix());
  gl.uniform3fv(place("centre"), scene.centre);
  gl.uniform1f(place("scale"), scene.scale);
  gl.uniform2fv(place("fit"), fit);
  gl.uniform3fv(place("tint"), tint);
  return place;
}

function drawTarget(fit) {
  const place = common(scene.target, fit, [0.83, 0.79, 0.72]);
  gl.uniform3fv(place("low"), scene.mesh.low);
  gl.uniform3fv(place("edge"), scene.mesh.edge);
  gl.bindVertexArray(scene.targetArray);
  gl.drawArrays(gl.TRIANGLES, 0, 3 * scene.mesh.count);
}

function drawClump(fit) {
  const tint = line().colour.match(/\d+/g).map((v) => v / 255);
  common(scene.balls, fit, tint);
  gl.bindVertexArray(scene.ballsArray);
  gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, scene.count);
}

function drawView() {
  if (!scene) return;
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(view.clientWidth * ratio), Math.round(view.clientHeight * ratio)];
  if (view.width !== w || view.height !== h) [view.width, view.height] = [w, h];
  gl.enable(gl.DEPTH_TEST);
  gl.viewport(0, 0, w, h);
  gl.clearColor(0.965, 0.965, 0.957, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const half = Math.floor(w / 2);
  const side = Math.min(half, h);
  const fit = [zoom * side / half, zoom * side / h];
  gl.viewport(0, 0, half, h);
  drawTarget(fit);
  gl.viewport(w - half, 0, half, h);
  drawClump(fit);
  if (at("over").checked) drawTarget(fit);
}

/// How many pixels of each half show something: what tests ask.
function shown() {
  const [w, h] = [view.width, view.height];
  const pixels = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const halves = [0, 0];
  for (let i = 0; i < w * h; i++)
    if (Math.abs(pixels[4 * i] - 246) + Math.abs(pixels[4 * i + 2] - 244) > 12) halves[i % w < w / 2 ? 0 : 1]++;
  return halves;
}

// ---- all together ----

function select(k, index) {
  const before = state.line;
  state.line = Math.min(Math.max(k, 0), data.lines.length - 1);
  state.index = Math.min(Math.max(index, 0), line().points.length - 1);
  if (before !== state.line) root.dataset.line = state.line;
  showFigures();
  [0, 1, 2].forEach(drawChart);
  load();
  drawView();
}

at("line").innerHTML = data.lines.map((l, k) => `<option value="${k}"></option>`).join("");
data.lines.forEach((l, k) => { at("line").options[k].textContent = l.name; });
data.lines.forEach((l) => {
  const entry = document.createElement("span");
  entry.innerHTML = `<i style="border-color:${l.colour}"></i>`;
  entry.append(l.name);
  at("legend").append(entry);
});
if (data.papers.length) {
  const entry = document.createElement("span");
  entry.textContent = `× ${data.papers[0].what} (as stated)`;
  at("legend").append(entry);
}
at("line").onchange = (e) => {
  const n = point().n;
  const points = data.lines[+e.target.value].points;
  const near = points.reduce((b, p, i) => Math.abs(p.n - n) < Math.abs(points[b].n - n) ? i : b, 0);
  select(+e.target.value, near);
};
at("n").oninput = (e) => select(state.line, +e.target.value);
at("take").onclick = () => select(state.line, line().choice);
at("over").onchange = drawView;
let last = null;
view.onpointerdown = (e) => { last = [e.clientX, e.clientY]; view.setPointerCapture(e.pointerId); };
view.onpointerup = () => { last = null; };
view.onpointermove = (e) => {
  if (!last) return;
  const [dx, dy] = [e.clientX - last[0], e.clientY - last[1]];
  last = [e.clientX, e.clientY];
  const angle = 0.008 * Math.hypot(dx, dy);
  if (angle > 0) turn = times(about([dy, dx, 0].map((v) => v / Math.hypot(dx, dy)), angle), turn);
  drawView();
};
view.addEventListener("wheel", (e) => {
  e.preventDefault();
  zoom = Math.min(Math.max(zoom * Math.exp(-0.001 * e.deltaY), 0.3), 12);
  drawView();
}, { passive: false });
window.onresize = () => select(state.line, state.index);

if (gl) build();
else at("named").textContent = "no WebGL2 here: the bodies cannot be shown";
const start = line().choice === null ? line().points.length - 1 : line().choice;
select(0, start);
if (gl) {
  const [left, right] = shown();
  root.dataset.target = left;
  root.dataset.clump = right;
}
root.dataset.state = gl ? "drawn" : "no-webgl";
