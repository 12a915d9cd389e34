"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const film = JSON.parse(byId("film").textContent);
  const canvas = byId("picture"), pen = canvas.getContext("2d");
  const slider = byId("frame");
  const FIELDS = ["x", "y", "vx", "vy", "angle", "omega"];
  const UNITS = { x: "px", y: "px", vx: "px/s", vy: "px/s", angle: "rad", omega: "rad/s", mass: "kg", moment: "kg px²" };

  // ---------------------------------------------------------------- frames

  // A frame tells only what changed: [time, steps, bodies, touches, rods, gone].
  function unfold(frames) {
    let bodies = new Map(), touches = [], rods = [];
    return frames.map(([time, steps, changed, newTouches, newRods, gone]) => {
      bodies = new Map(bodies);
      for (const number of gone) bodies.delete(number);
      for (const [number, ...state] of changed) bodies.set(number, state);
      touches = newTouches ?? touches;
      rods = newRods ?? rods;
      return { time, steps, bodies, touches, rods };
    });
  }

  const starts = [];
  let count = 0;
  for (const scene of film.scenes) {
    scene.mine = unfold(scene.yours);
    scene.right = unfold(scene.expected);
    starts.push(count);
    count += scene.mine.length;
  }
  const partAt = film.parting ? starts[film.parting.scene] + film.parting.frame : null;

  function at(position) {
    let number = starts.length - 1;
    while (starts[number] > position) number -= 1;
    const scene = film.scenes[number], frame = position - starts[number];
    const line = scene.lines.findLast((each) => each.at <= frame);
    return { scene, number, frame, line, mine: scene.mine[frame], right: scene.right[frame] };
  }

  // ---------------------------------------------------------------- what is in view

  const NOTHING = [Infinity, Infinity, -Infinity, -Infinity];
  const isFinitePlace = (state) => Number.isFinite(state[0]) && Number.isFinite(state[1]);
  const reach = (look) => Math.max(0, ...(look?.shapes ?? []).flatMap(
    ([points, radius]) => points.map(([x, y]) => Math.hypot(x, y) + radius)));

  // How far a body reaches in each direction: left, up, right, down.
  function extent(look) {
    if (look?.mass !== null) return [reach(look), reach(look), reach(look), reach(look)];
    let box = NOTHING;
    for (const [points, radius] of look.shapes) for (const [x, y] of points) box = around(box, x, y, radius);
    return [-box[0], -box[1], box[2], box[3]];
  }

  function around(box, x, y, r) {
    return [Math.min(box[0], x - r), Math.min(box[1], y - r), Math.max(box[2], x + r), Math.max(box[3], y + r)];
  }
  function boundsOf(frames, looks, wanted) {
    let box = NOTHING;
    for (const frame of frames) {
      for (const [number, state] of frame.bodies) {
        const look = looks[number];
        if (!isFinitePlace(state) || !wanted(look)) continue;
        const [left, up, right, down] = extent(look);
        box = [Math.min(box[0], state[0] - left), Math.min(box[1], state[1] - up), Math.max(box[2], state[0] + right), Math.max(box[3], state[1] + down)];
      }
    }
    return box;
  }

  // All that moves and what is no larger than that; of the rest what lies near.
  function viewOf(scene) {
    const both = [[scene.mine, scene.looks], [scene.right, scene.expected_looks]];
    const moves = (look) => look && look.mass !== null;
    const join = (wanted) => both.reduce((box, [frames, looks]) => {
      const other = boundsOf(frames, looks, wanted);
      return [Math.min(box[0], other[0]), Math.min(box[1], other[1]), Math.max(box[2], other[2]), Math.max(box[3], other[3])];
    }, NOTHING);
    let core = scene.right.length ? boundsOf(scene.right, scene.expected_looks, moves) : NOTHING;
    if (core[0] > core[2]) core = boundsOf(scene.mine, scene.looks, moves);
    if (core[0] > core[2]) core = join(() => true);
    if (core[0] > core[2]) core = [-50, -50, 50, 50];
    const size = Math.max(core[2] - core[0], core[3] - core[1], 2);
    const most = 1.5 * size;
    const limit = [core[0] - most, core[1] - most, core[2] + most, core[3] + most];
    const small = (look) => {
      const [left, up, right, down] = extent(look);
      return Math.max(left + right, up + down) <= 5 * size;
    };
    const near = join((look) => !moves(look) && small(look)), far = join(() => true);
    core = [0, 1, 2, 3].map((side) => {
      const outer = side < 2 ? Math.min : Math.max, inner = side < 2 ? Math.max : Math.min;
      const rim = core[side] + (side < 2 ? -size : size) / 3;
      return outer(core[side], inner(near[side], limit[side]), inner(far[side], rim));
    });
    const rim = Math.max(core[2] - core[0], core[3] - core[1]) * 0.06;
    return [core[0] - rim, core[1] - rim, core[2] + rim, core[3] + rim];
  }

  function curveView(scene) {
    let box = NOTHING;
    for (const frames of [scene.mine, scene.right]) {
      for (const frame of frames) {
        const state = frame.bodies.get(1);
        if (state && Number.isFinite(state[0])) box = around(box, frame.time, state[0], 0);
      }
    }
    if (box[0] > box[2]) return [0, -1, 1, 1];
    const tall = (box[3] - box[1] || 1) * 0.08, wide = (box[2] - box[0] || 1) * 0.04;
    return [box[0] - wide, box[1] - tall, box[2] + wide, box[3] + tall];
  }
  for (const scene of film.scenes) scene.view = scene.curve ? curveView(scene) : viewOf(scene);

  // ---------------------------------------------------------------- drawing

  let colours = {}, scale = 1, offset = [0, 0];

  function readColours() {
    const style = getComputedStyle(document.documentElement);
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

  function rods(frame, colour) {
    pen.strokeStyle = colour;
    pen.lineWidth = 2.5;
    for (const [ax, ay, bx, by] of frame.rods) {
      pen.beginPath();
      pen.moveTo(toX(ax), toY(ay));
      pen.lineTo(toX(bx), toY(by));
      pen.stroke();
    }
  }

  function touches(frame, colour) {
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = 2;
    for (const [x, y, nx, ny] of frame.touches) {
      pen.beginPath();
      pen.arc(toX(x), toY(y), 3, 0, 2 * Math.PI);
      pen.fill();
      const length = frame.touches.length > 3 ? 14 : 26;
      arrow(toX(x), toY(y), length * nx, length * ny);
    }
  }

  function drawYours(scene, frame, speedScale) {
    rods(frame, colours.ink);
    for (const [number, state] of frame.bodies) {
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
    touches(frame, colours.ink);
  }

  function drawExpected(scene, frame, speedScale) {
    pen.setLineDash([5, 4]);
    for (const [number, state] of frame.bodies) {
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
    rods(frame, colours.expected);
    pen.setLineDash([]);
    touches(frame, colours.expected);
  }

  function drawGap(mine, right) {
    pen.strokeStyle = colours.wrong;
    pen.lineWidth = 2;
    for (const [number, state] of mine.bodies) {
      const other = right.bodies.get(number);
      if (!other || !isFinitePlace(state) || !isFinitePlace(other)) continue;
      if (Math.hypot(state[0] - other[0], state[1] - other[1]) <= 0.5) continue;
      pen.beginPath();
      pen.moveTo(toX(state[0]), toY(state[1]));
      pen.lineTo(toX(other[0]), toY(other[1]));
      pen.stroke();
    }
  }

  // The fastest body's arrow takes an eighth of the picture.
  function arrowScale(scene, wide) {
    let fastest = 0;
    for (const frame of [...scene.mine, ...scene.right]) {
      for (const [, state] of frame.bodies) {
        const speed = Math.hypot(state[2], state[3]);
        if (Number.isFinite(speed)) fastest = Math.max(fastest, speed);
      }
    }
    return fastest ? wide / 8 / fastest : 0;
  }

  function drawCurve(scene, now, wide, tall) {
    const [left, low, right, high] = scene.view;
    const x = (time) => 48 + (time - left) / (right - left) * (wide - 60);
    const y = (value) => tall - 28 - (value - low) / (high - low) * (tall - 40);
    pen.strokeStyle = colours.line;
    pen.fillStyle = colours.soft;
    pen.font = "12px system-ui, sans-serif";
    pen.lineWidth = 1;
    for (let mark = 0; mark <= 4; mark += 1) {
      const value = low + (high - low) * mark / 4, time = left + (right - left) * mark / 4;
      pen.beginPath();
      pen.moveTo(48, y(value));
      pen.lineTo(wide - 12, y(value));
      pen.stroke();
      pen.fillText(digits(value, 3), 4, y(value) + 4);
      pen.textAlign = mark === 4 ? "right" : "center";
      pen.fillText(`${digits(Math.max(time, 0), 2)} s`, x(time), tall - 8);
      pen.textAlign = "left";
    }
    const trace = (frames, colour, dash) => {
      pen.strokeStyle = colour;
      pen.lineWidth = 2;
      pen.setLineDash(dash);
      pen.beginPath();
      frames.forEach((frame, index) => {
        const state = frame.bodies.get(1), time = scene.mine[index]?.time ?? frame.time;
        if (!state || !Number.isFinite(state[0])) return;
        if (index && time > scene.mine[index - 1].time) pen.lineTo(x(time), y(state[0]));
        else pen.moveTo(x(time), y(state[0]));
      });
      pen.stroke();
      pen.setLineDash([]);
    };
    trace(scene.mine, colours.yours, []);
    trace(scene.right, colours.expected, [6, 4]);
    for (const [frame, colour] of [[now.right, colours.expected], [now.mine, colours.yours]]) {
      const state = frame?.bodies.get(1);
      if (!state || !Number.isFinite(state[0])) continue;
      pen.fillStyle = colour;
      pen.beginPath();
      pen.arc(x(now.mine.time), y(state[0]), 5, 0, 2 * Math.PI);
      pen.fill();
    }
  }

  function draw() {
    const now = at(position), { scene } = now;
    const [wide, tall] = fit(scene);
    pen.clearRect(0, 0, wide, tall);
    if (scene.curve) {
      drawCurve(scene, now, wide, tall);
      return;
    }
    scene.arrows ??= arrowScale(scene, wide);
    drawYours(scene, now.mine, scene.arrows);
    if (now.right) {
      drawExpected(scene, now.right, scene.arrows);
      drawGap(now.mine, now.right);
    }
  }

  // ---------------------------------------------------------------- words and numbers

  const digits = (value, count = 6) =>
    value === undefined ? "" : value === null ? "not finite" : String(Number(value.toPrecision(count)));

  let position = partAt ?? 0, chosen = film.parting?.body || null;

  function showValues(now) {
    const { scene } = now;
    const known = now.mine.bodies.has(chosen) || now.right?.bodies.has(chosen);
    if (!known) {
      const moving = [...now.mine.bodies.keys()].find((each) => scene.looks[each]?.mass !== null);
      chosen = moving ?? [...now.mine.bodies.keys()][0] ?? null;
    }
    const mine = now.mine.bodies.get(chosen), right = now.right?.bodies.get(chosen);
    byId("who").textContent = chosen === null ? "" : scene.names[chosen] ?? `body ${chosen}`;
    const rows = FIELDS.filter((name) => !scene.curve || name === "x" || name === "vx").map((name) => {
      const index = FIELDS.indexOf(name);
      return [scene.curve && name === "vx" ? "v" : name, UNITS[name], mine?.[index], right?.[index]];
    });
    if (!scene.curve) {
      for (const name of ["mass", "moment"]) {
        const own = scene.looks[chosen]?.[name], other = scene.expected_looks[chosen]?.[name];
        if (own !== null && own !== undefined) rows.push([name, UNITS[name], own, other ?? undefined]);
      }
    }
    const body = byId("values").tBodies[0];
    body.replaceChildren(...rows.map(([name, unit, own, other]) => {
      const row = document.createElement("tr");
      row.append(cell("th", `${name} (${unit})`), cell("td", digits(own)), cell("td", digits(other)));
      const known = other !== undefined && other !== null;
      if (own === null || (known && Math.abs(own - other) > 1e-3 * Math.max(0.01, Math.abs(other)))) row.className = "off";
      return row;
    }));
  }

  function cell(tag, text) {
    const made = document.createElement(tag);
    made.textContent = text;
    if (tag === "th") made.scope = "row";
    return made;
  }

  function showTouches(now) {
    const mine = now.mine.touches, right = now.right?.touches ?? [];
    const rows = [];
    for (let index = 0; index < Math.min(4, Math.max(mine.length, right.length)); index += 1) {
      for (const [name, place, unit] of [["depth", 4, "px"], ["jn", 5, "kg px/s"], ["jt", 6, "kg px/s"]]) {
        const own = mine[index]?.[place], other = right[index]?.[place], row = document.createElement("tr");
        row.append(cell("th", `${name} ${index + 1} (${unit})`), cell("td", digits(own)), cell("td", digits(other)));
        if (now.right && own !== other && !(Math.abs(own - other) <= 1e-3 * Math.max(1e-3, Math.abs(other)))) row.className = "off";
        rows.push(row);
      }
    }
    byId("touches").hidden = !rows.length;
    byId("touches").tBodies[0].replaceChildren(...rows);
  }

  function showWords(now) {
    const steps = now.mine.steps > 1 || now.right?.steps > 1
      ? ` · ${now.mine.steps} steps${now.right && now.right.steps !== now.mine.steps ? ` (expected ${now.right.steps})` : ""}` : "";
    const time = now.mine.time ? ` · ${now.mine.time.toFixed(3)} s` : "";
    byId("moment").textContent = `frame ${position + 1} of ${count}${time}${steps}`;
    slider.setAttribute("aria-valuetext", byId("moment").textContent);
    byId("said").textContent = now.scene.said;
    byId("said").hidden = film.scenes.length === 1;
    byId("code").textContent = now.line?.code ?? "";
    const talks = Boolean(now.line && (now.line.yours || now.line.expected));
    byId("answers").hidden = !talks;
    byId("answer-yours").textContent = now.line?.yours ?? "";
    byId("answer-expected").textContent = now.line?.expected ?? "";
    byId("row-expected").hidden = !now.right;
    byId("answers").className = now.right && now.line?.yours !== now.line?.expected ? "answers off" : "answers";
    byId("play").textContent = timer === null ? "Play" : "Stop";
    const current = items.get(now.line);
    for (const item of items.values()) item.removeAttribute("aria-current");
    if (current) {
      current.setAttribute("aria-current", "true");
      const list = byId("lines");
      list.scrollTop = current.offsetTop - list.offsetTop - list.clientHeight / 2;
    }
  }

  function show() {
    const now = at(position);
    slider.value = position;
    showValues(now);
    showTouches(now);
    showWords(now);
    draw();
    canvas.dataset.position = position;
  }

  // ---------------------------------------------------------------- playing

  let timer = null;

  function go(to) {
    position = Math.max(0, Math.min(count - 1, to));
    show();
  }

  function stop() {
    clearTimeout(timer);
    timer = null;
    show();
  }

  // Real time where time runs; else as slowly as there is little to see.
  function pause() {
    const here = at(position), next = at(position + 1);
    const passed = here.scene === next.scene ? next.mine.time - here.mine.time : 0;
    const usual = Math.min(0.8, Math.max(1 / 30, 6 / count));
    return 1000 * (passed > 0 && passed < 1 ? passed : usual) / Number(byId("speed").value);
  }

  function advance() {
    if (position >= count - 1) {
      stop();
      return;
    }
    timer = setTimeout(() => {
      go(position + 1);
      advance();
    }, pause());
  }

  function toggle() {
    if (timer !== null) {
      stop();
      return;
    }
    if (position >= count - 1) position = 0;
    advance();
    show();
  }

  function step(by) {
    if (timer !== null) stop();
    go(position + by);
  }

  function toParting() {
    if (partAt === null) return;
    if (timer !== null) stop();
    if (film.parting.body) chosen = film.parting.body;
    go(partAt);
  }

  function nextBody() {
    const now = at(position), all = [...now.mine.bodies.keys()];
    if (all.length) chosen = all[(all.indexOf(chosen) + 1) % all.length];
    show();
  }

  // ---------------------------------------------------------------- hands

  const KEYS = {
    " ": toggle, ArrowLeft: () => step(-1), ArrowRight: () => step(1),
    Home: () => step(-count), End: () => step(count), p: toParting, P: toParting, b: nextBody, B: nextBody,
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || !(event.key in KEYS)) return;
    const on = event.target.tagName;
    if (on === "SELECT" || (on === "BUTTON" && event.key === " ")) return;
    event.preventDefault();
    KEYS[event.key]();
  });
  byId("play").addEventListener("click", toggle);
  byId("back").addEventListener("click", () => step(-1));
  byId("on").addEventListener("click", () => step(1));
  byId("part").addEventListener("click", toParting);
  slider.addEventListener("input", () => {
    if (timer !== null) stop();
    go(Number(slider.value));
  });

  canvas.addEventListener("pointermove", (event) => {
    const now = at(position);
    if (now.scene.curve) return;
    const box = canvas.getBoundingClientRect();
    const x = (event.clientX - box.left - offset[0]) / scale, y = (event.clientY - box.top - offset[1]) / scale;
    let best = Infinity, found = null;
    for (const [frame, looks] of [[now.mine, now.scene.looks], [now.right, now.scene.expected_looks]]) {
      for (const [number, state] of frame?.bodies ?? []) {
        const look = looks[number];
        if (!look || !isFinitePlace(state)) continue;
        const away = Math.hypot(state[0] - x, state[1] - y);
        if (away < best && away < reach(look) + 6 / scale && (look.mass !== null || reach(look) < 60)) [best, found] = [away, number];
      }
    }
    if (found !== null && found !== chosen) {
      chosen = found;
      show();
    }
  });

  byId("copy").addEventListener("click", async () => {
    const text = byId("script").textContent;
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      getSelection().selectAllChildren(byId("script"));
      document.execCommand("copy");
    }
    byId("copy").textContent = "Copied";
  });

  // ---------------------------------------------------------------- the page

  const items = new Map();
  film.scenes.forEach((scene, number) => {
    for (const line of scene.lines.filter((each) => each.code)) {
      const item = document.createElement("li"), way = document.createElement("button");
      way.type = "button";
      way.textContent = line.code;
      way.addEventListener("click", () => step(starts[number] + line.at - position));
      item.append(way);
      items.set(line, item);
      byId("lines").append(item);
    }
  });

  const words = byId("parting");
  if (film.parting) {
    words.textContent = `The runs part in frame ${partAt + 1} of ${count}: ${film.parting.words}.`;
    words.className = "parting apart";
    const mark = byId("mark"), share = count > 1 ? partAt / (count - 1) : 0;
    mark.hidden = false;
    mark.style.left = `calc(${100 * share}% + ${0.5 - share}rem)`;
  } else if (film.compared) {
    words.textContent = "Nothing is visibly off: the difference is in the numbers named above.";
  } else {
    words.textContent = "The right run is not known here: this is yours alone.";
    byId("key-expected").hidden = true;
    for (const each of document.querySelectorAll(".right")) each.hidden = true;
  }
  byId("part").disabled = partAt === null;
  slider.max = count - 1;
  if (window !== window.top) document.body.className = "framed";
  readColours();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    readColours();
    draw();
  });
  new ResizeObserver(() => {
    for (const scene of film.scenes) scene.arrows = undefined;
    draw();
  }).observe(canvas.parentElement);
  show();
})();
