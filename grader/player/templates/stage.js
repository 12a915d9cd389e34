// The stage draws one scene of a replay on a canvas, moment by moment; it needs no page around it.
//
// A scene has `yours` and `expected`, two lists of moments, and the looks of the bodies in each. Without
// a right run, `expected` is empty.
"use strict";

function stageOn(canvas) {
  const digits = (value, count = 6) =>
    value === undefined ? "" : value === null ? "not finite" : String(Number(value.toPrecision(count)));
  const pen = canvas.getContext("2d");

  // ---------------------------------------------------------------- moments

  // A moment has only changes: [time, steps, bodies, touches, rods, gone].
  function unfold(moments) {
    let bodies = new Map(), touches = [], rods = [];
    return moments.map(([time, steps, changed, newTouches, newRods, gone]) => {
      bodies = new Map(bodies);
      for (const number of gone) bodies.delete(number);
      for (const [number, ...state] of changed) bodies.set(number, state);
      touches = newTouches ?? touches;
      rods = newRods ?? rods;
      return { time, steps, bodies, touches, rods };
    });
  }

  // Unfold the moments of both runs, and choose the view.
  function prepare(scene) {
    scene.yours = unfold(scene.yours);
    scene.expected = unfold(scene.expected);
    scene.view ??= scene.curve ? curveView(scene) : viewOf(scene);
    return scene;
  }

  // ---------------------------------------------------------------- the view

  // A box is [left, top, right, bottom].
  const NOTHING = [Infinity, Infinity, -Infinity, -Infinity];
  const isEmpty = (box) => box[0] > box[2];
  const merge = (a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
  const clip = (a, b) => [Math.max(a[0], b[0]), Math.max(a[1], b[1]), Math.min(a[2], b[2]), Math.min(a[3], b[3])];
  const grow = ([left, top, right, bottom], x, y = x) => [left - x, top - y, right + x, bottom + y];

  const isFinitePlace = (state) => Number.isFinite(state[0]) && Number.isFinite(state[1]);
  const reach = (look) => Math.max(0, ...(look?.shapes ?? []).flatMap(
    ([points, radius]) => points.map(([x, y]) => Math.hypot(x, y) + radius)));

  // Return the box of a body at [0, 0]; of a moving body in any direction.
  function extent(look) {
    if (look?.mass !== null) return grow([0, 0, 0, 0], reach(look));
    return look.shapes.flatMap(([points, radius]) => points.map(([x, y]) => grow([x, y, x, y], radius))).reduce(merge, NOTHING);
  }

  function boundsOf(moments, looks, wanted) {
    let box = NOTHING;
    for (const moment of moments) {
      for (const [number, state] of moment.bodies) {
        if (!isFinitePlace(state) || !wanted(looks[number])) continue;
        const [x, y] = state, [left, top, right, bottom] = extent(looks[number]);
        box = merge(box, [x + left, y + top, x + right, y + bottom]);
      }
    }
    return box;
  }

  // Show all that moves and bodies of similar size; of the rest, the near part.
  function viewOf(scene) {
    const moves = (look) => look && look.mass !== null, all = () => true;
    const yours = (wanted) => boundsOf(scene.yours, scene.looks, wanted);
    const expected = (wanted) => boundsOf(scene.expected, scene.expected_looks, wanted);
    const both = (wanted) => merge(yours(wanted), expected(wanted));
    const core = [expected(moves), yours(moves), both(all), [-50, -50, 50, 50]].find((box) => !isEmpty(box));
    const size = Math.max(core[2] - core[0], core[3] - core[1], 2);
    const isSmall = (look) => {
      const [left, top, right, bottom] = extent(look);
      return Math.max(right - left, bottom - top) <= 5 * size;
    };
    const near = clip(both((look) => !moves(look) && isSmall(look)), grow(core, 1.5 * size));
    const far = clip(both(all), grow(core, size / 3));
    const view = merge(core, merge(near, far));
    return grow(view, 0.06 * Math.max(view[2] - view[0], view[3] - view[1]));
  }

  function curveView(scene) {
    let box = NOTHING;
    for (const { time, bodies } of [...scene.yours, ...scene.expected]) {
      const x = bodies.get(1)?.[0];
      if (Number.isFinite(x)) box = merge(box, [time, x, time, x]);
    }
    if (isEmpty(box)) return [0, -1, 1, 1];
    return grow(box, (box[2] - box[0] || 1) * 0.04, (box[3] - box[1] || 1) * 0.08);
  }

  // ---------------------------------------------------------------- drawing

  let colours = {}, scale = 1, offset = [0, 0];

  function readColours() {
    const style = getComputedStyle(canvas);
    for (const name of ["paper", "ink", "soft", "line", "yours", "expected", "fixed", "wrong"]) {
      colours[name] = style.getPropertyValue(`--${name}`).trim();
    }
  }

  const toX = (x) => offset[0] + x * scale, toY = (y) => offset[1] + y * scale;

  function fit(scene) {
    const wide = canvas.clientWidth || 800;
    const [left, top, right, bottom] = scene.view;
    const aspect = scene.curve ? 0.5 : Math.min(0.75, Math.max(0.3, (bottom - top) / (right - left)));
    const tall = Math.min(420, Math.round(wide * aspect)), dots = window.devicePixelRatio || 1;
    canvas.style.height = `${tall}px`;
    if (canvas.width !== Math.round(wide * dots) || canvas.height !== Math.round(tall * dots)) {
      canvas.width = Math.round(wide * dots);
      canvas.height = Math.round(tall * dots);
    }
    pen.setTransform(dots, 0, 0, dots, 0, 0);
    scale = Math.min(wide / (right - left), tall / (bottom - top));
    offset = [(wide - scale * (left + right)) / 2, (tall - scale * (top + bottom)) / 2];
    return [wide, tall];
  }

  function outline(state, look) {
    const turn = Number.isFinite(state[4]) ? state[4] : 0, cos = Math.cos(turn), sin = Math.sin(turn);
    const place = ([x, y]) => [toX(state[0] + x * cos - y * sin), toY(state[1] + x * sin + y * cos)];
    pen.beginPath();
    for (const [points, radius] of look.shapes) {
      const corners = points.map(place);
      if (corners.length === 1) {
        pen.moveTo(corners[0][0] + radius * scale, corners[0][1]);
        pen.arc(...corners[0], radius * scale, 0, 2 * Math.PI);
      } else if (corners.length) {
        corners.forEach(([x, y], index) => (index ? pen.lineTo(x, y) : pen.moveTo(x, y)));
        pen.closePath();
      }
    }
    return look.shapes.length === 1 && look.shapes[0][0].length === 1 ? look.shapes[0][1] : 0;
  }

  function spoke(state, radius) {
    if (!radius || !Number.isFinite(state[4])) return;
    pen.beginPath();
    pen.moveTo(toX(state[0]), toY(state[1]));
    pen.lineTo(toX(state[0] + radius * Math.cos(state[4])), toY(state[1] + radius * Math.sin(state[4])));
    pen.stroke();
  }

  function arrow(x, y, dx, dy) {
    const length = Math.hypot(dx, dy);
    if (!(length > 2)) return;
    const head = Math.min(8, length / 2), ux = dx / length, uy = dy / length;
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x + dx, y + dy);
    pen.moveTo(x + dx - head * (ux + 0.5 * uy), y + dy - head * (uy - 0.5 * ux));
    pen.lineTo(x + dx, y + dy);
    pen.lineTo(x + dx - head * (ux - 0.5 * uy), y + dy - head * (uy + 0.5 * ux));
    pen.stroke();
  }

  function rods(moment, colour) {
    pen.strokeStyle = colour;
    pen.lineWidth = 2.5;
    for (const [ax, ay, bx, by] of moment.rods) {
      pen.beginPath();
      pen.moveTo(toX(ax), toY(ay));
      pen.lineTo(toX(bx), toY(by));
      pen.stroke();
    }
  }

  // Draw points and normals. If impulses are known, an arrow shows the one on the second body, and
  // the two lines of a cone show how far friction may turn it from the normal.
  function touches(moment, colour) {
    pen.strokeStyle = pen.fillStyle = colour;
    const largest = Math.max(...moment.touches.map(([, , , , , jn, jt]) => Math.hypot(jn, jt)), 0);
    for (const [x, y, nx, ny, , jn, jt, limit] of moment.touches) {
      const px = toX(x), py = toY(y), length = moment.touches.length > 3 ? 14 : 26;
      pen.lineWidth = 2;
      pen.beginPath();
      pen.arc(px, py, 3, 0, 2 * Math.PI);
      pen.fill();
      if (!(largest > 0) || !Number.isFinite(largest)) {
        arrow(px, py, length * nx, length * ny);
        continue;
      }
      const unit = 2.5 * length / largest;
      arrow(px, py, unit * (jn * nx - jt * ny), unit * (jn * ny + jt * nx));
      if (!(limit > 0 && jn > 0)) continue;
      pen.lineWidth = 1;
      pen.setLineDash([3, 3]);
      for (const side of [-limit, limit]) {
        pen.beginPath();
        pen.moveTo(px, py);
        pen.lineTo(px + 1.2 * unit * (jn * nx - side * ny), py + 1.2 * unit * (jn * ny + side * nx));
        pen.stroke();
      }
      pen.setLineDash([]);
    }
  }

  // Draw arms, the axis of an impulse at their ends, and the velocity that a unit of it gives them.
  function drawMarks(scene, moment, marks) {
    const ends = [];
    for (const [number, x, y, axisX, axisY] of marks) {
      const state = moment.bodies.get(number), look = scene.looks[number];
      if (!state || !look) continue;
      const perMass = look.mass ? 1 / look.mass : 0, perMoment = look.moment ? 1 / look.moment : 0;
      const spin = (x * axisY - y * axisX) * perMoment;
      ends.push({ state, x, y, axisX, axisY, vx: axisX * perMass - spin * y, vy: axisY * perMass + spin * x });
    }
    const fastest = Math.max(...ends.map(({ vx, vy }) => Math.hypot(vx, vy)), 0);
    for (const { state, x, y, axisX, axisY, vx, vy } of ends) {
      const px = toX(state[0] + x), py = toY(state[1] + y);
      pen.strokeStyle = colours.ink;
      pen.lineWidth = 2;
      pen.setLineDash([4, 3]);
      pen.beginPath();
      pen.moveTo(toX(state[0]), toY(state[1]));
      pen.lineTo(px, py);
      pen.stroke();
      pen.setLineDash([]);
      pen.strokeStyle = colours.soft;
      arrow(px, py, 34 * axisX, 34 * axisY);
      pen.strokeStyle = colours.wrong;
      pen.lineWidth = 3;
      if (fastest) arrow(px, py, 60 * vx / fastest, 60 * vy / fastest);
    }
  }

  // Draw a scale of a round number of px.
  function drawScale(wide, tall) {
    const most = wide / 5 / scale, power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map((each) => each * power).find((each) => each <= most);
    pen.strokeStyle = pen.fillStyle = colours.soft;
    pen.lineWidth = 2;
    pen.beginPath();
    pen.moveTo(wide - 10 - length * scale, tall - 8);
    pen.lineTo(wide - 10, tall - 8);
    pen.stroke();
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "right";
    pen.fillText(`${length >= 1 ? length : length.toPrecision(1)} px`, wide - 10, tall - 13);
    pen.textAlign = "left";
  }

  function drawYours(scene, moment, speedScale, chosen) {
    rods(moment, colours.ink);
    for (const [number, state] of moment.bodies) {
      const look = scene.looks[number];
      if (!look || !isFinitePlace(state)) continue;
      const moves = look.mass !== null, radius = outline(state, look);
      pen.globalAlpha = moves ? 0.75 : 0.55;
      pen.fillStyle = moves ? colours.yours : colours.fixed;
      pen.fill();
      pen.globalAlpha = 1;
      if (number === chosen) {
        pen.strokeStyle = colours.ink;
        pen.lineWidth = 2;
        pen.stroke();
      }
      if (moves) {
        pen.strokeStyle = colours.paper;
        pen.lineWidth = 2;
        spoke(state, radius);
        pen.strokeStyle = colours.yours;
        arrow(toX(state[0]), toY(state[1]), state[2] * speedScale, state[3] * speedScale);
      }
    }
    touches(moment, colours.ink);
  }

  function drawExpected(scene, moment, speedScale) {
    pen.setLineDash([5, 4]);
    for (const [number, state] of moment.bodies) {
      const look = scene.expected_looks[number] ?? scene.looks[number];
      if (!look || !isFinitePlace(state) || look.mass === null) continue;
      pen.strokeStyle = colours.expected;
      pen.lineWidth = 2;
      const radius = outline(state, look);
      pen.stroke();
      spoke(state, radius);
      pen.setLineDash([]);
      arrow(toX(state[0]), toY(state[1]), state[2] * speedScale, state[3] * speedScale);
      pen.setLineDash([5, 4]);
    }
    rods(moment, colours.expected);
    pen.setLineDash([]);
    touches(moment, colours.expected);
  }

  function drawGap(yours, expected) {
    pen.strokeStyle = colours.wrong;
    pen.lineWidth = 2;
    for (const [number, state] of yours.bodies) {
      const other = expected.bodies.get(number);
      if (!other || !isFinitePlace(state) || !isFinitePlace(other)) continue;
      if (Math.hypot(state[0] - other[0], state[1] - other[1]) <= 0.5) continue;
      pen.beginPath();
      pen.moveTo(toX(state[0]), toY(state[1]));
      pen.lineTo(toX(other[0]), toY(other[1]));
      pen.stroke();
    }
  }

  // Return the scale at which the fastest body's arrow takes an eighth of the picture.
  function arrowScale(scene, wide) {
    let fastest = 0;
    for (const moment of [...scene.yours, ...scene.expected]) {
      for (const [, state] of moment.bodies) {
        const speed = Math.hypot(state[2], state[3]);
        if (Number.isFinite(speed)) fastest = Math.max(fastest, speed);
      }
    }
    return fastest ? wide / 8 / fastest : 0;
  }

  // Return three to six round numbers between two others.
  function roundNumbers(low, high) {
    const rough = (high - low) / 3, power = 10 ** Math.floor(Math.log10(rough));
    const apart = [5, 2, 1].map((each) => each * power).find((each) => each <= rough);
    const first = Math.ceil(low / apart), count = Math.floor(high / apart) - first + 1;
    return Number.isFinite(apart) ? Array.from({ length: count }, (_, n) => (first + n) * apart) : [];
  }

  function drawCurve(scene, now, wide, tall) {
    const [left, low, right, high] = scene.view;
    const x = (time) => 48 + (time - left) / (right - left) * (wide - 60);
    const y = (value) => tall - 28 - (value - low) / (high - low) * (tall - 40);
    pen.strokeStyle = colours.line;
    pen.fillStyle = colours.soft;
    pen.font = "12px system-ui, sans-serif";
    pen.lineWidth = 1;
    for (const value of roundNumbers(low, high)) {
      pen.beginPath();
      pen.moveTo(48, y(value));
      pen.lineTo(wide - 12, y(value));
      pen.stroke();
      pen.fillText(digits(value, 3), 4, y(value) + 4);
    }
    for (const time of roundNumbers(Math.max(left, 0), right)) {
      pen.textAlign = x(time) > wide - 24 ? "right" : "center";
      pen.fillText(`${digits(time, 3)} s`, x(time), tall - 8);
    }
    pen.textAlign = "left";
    const trace = (moments, colour, dash) => {
      pen.strokeStyle = colour;
      pen.lineWidth = 2;
      pen.setLineDash(dash);
      pen.beginPath();
      moments.forEach((moment, index) => {
        const state = moment.bodies.get(1), time = scene.yours[index]?.time ?? moment.time;
        if (!state || !Number.isFinite(state[0])) return;
        if (index && time > scene.yours[index - 1].time) pen.lineTo(x(time), y(state[0]));
        else pen.moveTo(x(time), y(state[0]));
      });
      pen.stroke();
      pen.setLineDash([]);
    };
    trace(scene.yours, colours.yours, []);
    trace(scene.expected, colours.expected, [6, 4]);
    for (const [moment, colour] of [[now.expected, colours.expected], [now.yours, colours.yours]]) {
      const state = moment?.bodies.get(1);
      if (!state || !Number.isFinite(state[0])) continue;
      pen.fillStyle = colour;
      pen.beginPath();
      pen.arc(x(now.yours.time), y(state[0]), 5, 0, 2 * Math.PI);
      pen.fill();
    }
  }

  // `now` has a scene and its moments `yours` and `expected`; the body `chosen` gets an outline.
  function draw(now, chosen = null) {
    const { scene } = now;
    const [wide, tall] = fit(scene);
    pen.clearRect(0, 0, wide, tall);
    if (scene.curve) {
      drawCurve(scene, now, wide, tall);
      return;
    }
    scene.arrows ??= arrowScale(scene, wide);
    drawYours(scene, now.yours, scene.arrows, chosen);
    if (now.expected) {
      drawExpected(scene, now.expected, scene.arrows);
      drawGap(now.yours, now.expected);
    }
    drawMarks(scene, now.yours, now.line?.marks ?? []);
    drawScale(wide, tall);
  }

  // Return the px of the picture per px of a scene; of a curve, along its height.
  function scaleOf(scene) {
    const [, tall] = fit(scene), [, low, , high] = scene.view;
    return scene.curve ? (tall - 40) / (high - low) : scale;
  }

  // Convert a point of the page to the scene, px; also return the px of the scene per px of the page.
  function place(event) {
    const box = canvas.getBoundingClientRect();
    return { x: (event.clientX - box.left - offset[0]) / scale, y: (event.clientY - box.top - offset[1]) / scale, px: 1 / scale };
  }

  return { prepare, draw, place, scaleOf, readColours, reach, isFinitePlace, digits };
}
