// The drawing of a scene, and curves.
'use strict';

// Those of the style sheet, which has a light and a dark set.
const colour = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['ink', 'faint', 'grid', 'paper', 'blue', 'vermilion', 'orange', 'pale'])
    colour[name] = style.getPropertyValue('--' + name).trim();
}
readColours();
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', readColours);
const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99],
  [170, 220, 50], [253, 231, 37]];

function strainColour(part) {
  const at = Math.min(Math.max(part, 0), 1) * (viridis.length - 1), i = Math.min(Math.floor(at), viridis.length - 2);
  return `rgb(${viridis[i].map((c, k) => Math.round(c + (at - i) * (viridis[i + 1][k] - c)))})`;
}

// The context of a canvas as large as it is shown, in its pixels of CSS.
function contextOf(canvas) {
  const zoom = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * zoom) || canvas.height !== Math.round(height * zoom)) {
    canvas.width = Math.round(width * zoom);
    canvas.height = Math.round(height * zoom);
  }
  const c = canvas.getContext('2d');
  c.setTransform(zoom, 0, 0, zoom, 0, 0);
  c.clearRect(0, 0, width, height);
  return {c, width, height};
}

// From metres of the scene to pixels.  Where w is magnified the ball keeps its size, and is moved so that it still meets the beam.
class View {
  constructor(scene, canvas, reach) {
    const [x0, x1, w0, w1] = scene.view;
    this.scale = Math.min(canvas.clientWidth / (x1 - x0), canvas.clientHeight / (w1 - w0));
    this.left = (canvas.clientWidth - this.scale * (x0 + x1)) / 2;
    this.top = (canvas.clientHeight + this.scale * (w0 + w1)) / 2;
    this.magnified = scene.magnified;
    this.reach = reach;
    this.halfBeam = 3.5;
    this.ball = scene.magnified === 1 ? Math.max(reach * this.scale - this.halfBeam, 6) : 11;
  }
  line(x, w) { return [this.left + this.scale * x, this.top - this.scale * this.magnified * w]; }
  // A place of the avatar's centre.  side: of the beam, 1 above.
  place(x, w, side) {
    const [px, py] = this.line(x, w - (this.magnified === 1 ? 0 : side * this.reach));
    return [px, py - (this.magnified === 1 ? 0 : side * (this.ball + this.halfBeam))];
  }
  // The other way.
  scenePlace(px, py, side) {
    const moved = this.magnified === 1 ? 0 : side * (this.ball + this.halfBeam);
    const w = (this.top - py - moved) / (this.scale * this.magnified) + (this.magnified === 1 ? 0 : side * this.reach);
    return [(px - this.left) / this.scale, w];
  }
}

function path(c, points) {
  c.beginPath();
  points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
}

function drawSupport(c, [x, y], kind, right) {
  c.strokeStyle = c.fillStyle = colour.ink;
  c.lineWidth = 1.4;
  const hatch = (x0, y0, dx, dy, hx, hy) => {
    path(c, [[x0, y0], [x0 + 6 * dx, y0 + 6 * dy]]);
    for (let k = 0; k < 6; ++k) c.moveTo(x0 + (k + 1) * dx, y0 + (k + 1) * dy), c.lineTo(x0 + k * dx + hx, y0 + k * dy + hy);
    c.stroke();
  };
  if (kind === 'pinned') {
    path(c, [[x, y], [x - 10, y + 17], [x + 10, y + 17], [x, y]]);
    c.stroke();
    hatch(x - 15, y + 17, 5, 0, 0, 6);
    c.beginPath();
    c.arc(x, y, 3.5, 0, 7);
    c.fillStyle = colour.paper;
    c.fill();
    c.stroke();
  } else if (kind === 'clamped') {
    hatch(x, y - 21, 0, 7, right ? 6 : -6, 7);
  }
}

function drawBeam(c, view, points, worst) {
  const at = [];
  for (let k = 0; k < points.length; k += 3) at.push(view.line(points[k], points[k + 1]));
  c.lineCap = c.lineJoin = 'round';
  path(c, at);
  c.strokeStyle = colour.ink;
  c.lineWidth = 2 * view.halfBeam;
  c.stroke();
  c.lineWidth = 2 * view.halfBeam - 2.4;
  for (let k = 1; k < at.length; ++k) {
    c.strokeStyle = strainColour(Math.sqrt(points[3 * k + 2] / worst));
    path(c, [at[k - 1], at[k]]);
    c.stroke();
  }
  return at;
}

function drawSpring(c, from, to) {
  const dx = to[0] - from[0], dy = to[1] - from[1], length = Math.hypot(dx, dy);
  if (length < 3) return;
  const turns = 9, width = Math.min(6, length / 4), points = [from];
  for (let k = 0; k < 2 * turns; ++k) {
    const t = (k + 0.5) / (2 * turns), side = (k % 2 ? 1 : -1) * width / length;
    points.push([from[0] + t * dx - side * dy, from[1] + t * dy + side * dx]);
  }
  path(c, [...points, to]);
  c.strokeStyle = colour.blue;
  c.lineWidth = 1.8;
  c.stroke();
}

function drawArrow(c, [x, y], dx, dy) {
  const length = Math.hypot(dx, dy);
  if (length < 6) return;
  const ex = dx / length, ey = dy / length, tip = [x + dx, y + dy];
  c.strokeStyle = c.fillStyle = colour.vermilion;
  c.lineWidth = 2.6;
  path(c, [[x, y], [tip[0] - 6 * ex, tip[1] - 6 * ey]]);
  c.stroke();
  path(c, [tip, [tip[0] - 10 * ex - 5 * ey, tip[1] - 10 * ey + 5 * ex], [tip[0] - 10 * ex + 5 * ey, tip[1] - 10 * ey - 5 * ex]]);
  c.fill();
}

function drawHand(c, [x, y]) {
  c.strokeStyle = colour.blue;
  c.lineWidth = 2;
  c.beginPath();
  c.arc(x, y, 6, 0, 7);
  c.moveTo(x - 11, y);
  c.lineTo(x + 11, y);
  c.moveTo(x, y - 11);
  c.lineTo(x, y + 11);
  c.stroke();
}

function drawBall(c, [x, y], radius) {
  c.beginPath();
  c.arc(x, y, radius, 0, 7);
  c.fillStyle = colour.orange;
  c.strokeStyle = colour.ink;
  c.lineWidth = 1.6;
  c.fill();
  c.stroke();
}

// 1, 2 or 5 times a power of ten, at least value.
function roundUp(value) {
  const unit = 10 ** Math.floor(Math.log10(Math.max(value, 1e-9)));
  return [1, 2, 5, 10].find((k) => k * unit >= value * 0.999) * unit;
}

// Curves [{points: [[x, y] …], colour, width}] in a frame from x0 to x1 and 0 to top.
function drawCurves(canvas, curves, {x0, x1, top, xUnit, yUnit, xLabels}) {
  const {c, width, height} = contextOf(canvas);
  const left = 48, right = width - 10, low = height - 22, high = 10;
  const X = (x) => left + (x - x0) / (x1 - x0) * (right - left), Y = (y) => low - y / top * (low - high);
  c.font = '12px system-ui, "DejaVu Sans", sans-serif';
  c.fillStyle = colour.faint;
  c.strokeStyle = colour.grid;
  c.lineWidth = 1;
  for (let k = 0; k <= 2; ++k) {
    path(c, [[left, Y(top * k / 2)], [right, Y(top * k / 2)]]);
    c.stroke();
    c.textAlign = 'right';
    c.fillText(`${+(top * k / 2).toPrecision(3)}${k === 2 ? ' ' + yUnit : ''}`, left - 6, Y(top * k / 2) + 4);
  }
  xLabels.forEach((x, k) => {
    path(c, [[X(x), low], [X(x), high]]);
    c.stroke();
    c.textAlign = k === xLabels.length - 1 ? 'right' : 'center';
    c.fillText(`${+x.toPrecision(3)}${k === xLabels.length - 1 ? ' ' + xUnit : ''}`, X(x), height - 6);
  });
  c.save();
  c.beginPath();
  c.rect(left, high - 4, right - left + 4, low - high + 6);
  c.clip();
  c.lineJoin = 'round';
  for (const {points, colour: stroke, width: line, dot} of curves) {
    if (!points.length) continue;
    path(c, points.map(([x, y]) => [X(x), Y(y)]));
    c.strokeStyle = c.fillStyle = stroke;
    c.lineWidth = line;
    c.stroke();
    if (dot) {
      const [x, y] = points[points.length - 1];
      c.beginPath();
      c.arc(X(x), Y(y), 4, 0, 7);
      c.fill();
    }
  }
  c.restore();
}
