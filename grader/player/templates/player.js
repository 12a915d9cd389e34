"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const replay = JSON.parse(byId("replay").textContent);
  const canvas = byId("picture"), stage = stageOn(canvas), { digits } = stage;
  const slider = byId("moment");
  const FIELDS = ["x", "y", "vx", "vy", "angle", "omega"];
  const UNITS = { x: "px", y: "px", vx: "px/s", vy: "px/s", angle: "rad", omega: "rad/s", mass: "kg", moment: "kg px²" };

  // ---------------------------------------------------------------- moments

  const starts = [];
  let count = 0;
  for (const scene of replay.scenes) {
    stage.prepare(scene);
    starts.push(count);
    count += scene.yours.length;
  }
  const partAt = replay.parting ? starts[replay.parting.scene] + replay.parting.moment : null;

  function at(position) {
    let number = starts.length - 1;
    while (starts[number] > position) number -= 1;
    const scene = replay.scenes[number], moment = position - starts[number];
    const line = scene.lines.findLast((each) => each.at <= moment);
    return { scene, number, moment, line, yours: scene.yours[moment], expected: scene.expected[moment] };
  }

  // Return the distance of the runs in a moment, px of the picture; Infinity if a body is missing.
  function apart(position) {
    const { scene, yours, expected } = at(position);
    if (!expected) return 0;
    let most = 0;
    for (const [number, state] of yours.bodies) {
      const other = expected.bodies.get(number);
      if (!other) return Infinity;
      const away = Math.hypot(state[0] - other[0], state[1] - other[1]);
      if (Number.isFinite(away)) most = Math.max(most, away * scene.scale);
    }
    return most;
  }

  const VISIBLE = 2; // px of the picture
  for (const scene of replay.scenes) scene.scale = stage.scaleOf(scene);
  const gaps = Array.from({ length: count }, (_, position) => apart(position));
  const seenAt = gaps.findIndex((gap) => gap >= VISIBLE);
  const largestAt = gaps.reduce((best, gap, position) => (gap > gaps[best] ? position : best), 0);
  // ---------------------------------------------------------------- words and numbers

  // Open where the difference is visible; without a difference, at the end.
  const nowhere = partAt ?? (replay.note ? count - 1 : 0);
  let position = seenAt < 0 ? nowhere : seenAt, chosen = replay.parting?.body || null;

  function showValues(now) {
    const { scene } = now;
    const known = now.yours.bodies.has(chosen) || now.expected?.bodies.has(chosen);
    if (!known) {
      const moving = [...now.yours.bodies.keys()].find((each) => scene.looks[each]?.mass !== null);
      chosen = moving ?? [...now.yours.bodies.keys()][0] ?? null;
    }
    const yours = now.yours.bodies.get(chosen), expected = now.expected?.bodies.get(chosen);
    byId("who").textContent = chosen === null ? "" : scene.names[chosen] ?? `body ${chosen}`;
    const rows = FIELDS.filter((name) => !scene.curve || name === "x" || name === "vx").map((name) => {
      const index = FIELDS.indexOf(name);
      return [scene.curve && name === "vx" ? "v" : name, UNITS[name], yours?.[index], expected?.[index]];
    });
    if (!scene.curve) {
      for (const name of ["mass", "moment"]) {
        const own = scene.looks[chosen]?.[name], other = scene.expected_looks[chosen]?.[name];
        if (own !== null && own !== undefined) rows.push([name === "moment" ? "moment of inertia" : name, UNITS[name], own, other ?? undefined]);
      }
    }
    byId("values").tBodies[0].replaceChildren(...rows.map(([name, unit, own, other]) => makeRow(
      `${name} (${unit})`, own, other, own === null || (Number.isFinite(other) && differs(own, other)))));
  }

  const differs = (own, other) => own !== other && !(Math.abs(own - other) <= 1e-3 * Math.max(0.01, Math.abs(other)));

  // Make the row of a table: a number of both runs, highlighted if it `isOff`.
  function makeRow(name, own, other, isOff) {
    const row = document.createElement("tr"), head = document.createElement("th");
    head.scope = "row";
    head.textContent = name;
    row.append(head);
    for (const value of [own, other]) row.insertCell().textContent = digits(value);
    if (isOff) row.className = "off";
    return row;
  }

  function showTouches(now) {
    const yours = now.yours.touches, expected = now.expected?.touches ?? [];
    const rows = [];
    for (let index = 0; index < Math.min(4, Math.max(yours.length, expected.length)); index += 1) {
      for (const [name, place, unit] of [["depth", 4, "px"], ["jn", 5, "kg px/s"], ["jt", 6, "kg px/s"]]) {
        const own = yours[index]?.[place], other = expected[index]?.[place];
        rows.push(makeRow(`contact ${index + 1}: ${name} (${unit})`, own, other, now.expected && differs(own, other)));
      }
    }
    byId("touches").hidden = !rows.length;
    byId("touches").tBodies[0].replaceChildren(...rows);
  }

  // Explain the lines in the picture.
  function legend(now) {
    if (now.line?.marks.length) return "Dashed: the arm. Grey: the axis. Red: the velocity that an impulse along it gives that point.";
    const pushed = now.yours.touches.some(([, , , , , jn, , limit]) => jn > 0 && limit > 0);
    return pushed ? "Arrow at a contact: its impulse. Dashed: how far friction may turn it." : "";
  }

  function showWords(now) {
    const steps = now.yours.steps > 1 || now.expected?.steps > 1
      ? ` · ${now.yours.steps} steps${now.expected && now.expected.steps !== now.yours.steps ? ` (expected ${now.expected.steps})` : ""}` : "";
    const time = now.yours.time ? ` · ${now.yours.time.toFixed(3)} s` : "";
    byId("position").textContent = `moment ${position + 1} of ${count}${time}${steps}`;
    slider.setAttribute("aria-valuetext", byId("position").textContent);
    byId("legend").textContent = legend(now);
    byId("experiment").textContent = now.scene.experiment;
    byId("experiment").hidden = replay.scenes.length === 1;
    byId("code").textContent = now.line?.code ?? "";
    const talks = Boolean(now.line && (now.line.yours || now.line.expected));
    byId("answers").hidden = !talks;
    byId("answer-yours").textContent = now.line?.yours ?? "";
    byId("answer-expected").textContent = now.line?.expected ?? "";
    byId("row-expected").hidden = !now.expected;
    byId("answers").className = now.expected && now.line?.yours !== now.line?.expected ? "answers off" : "answers";
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
    stage.draw(now, chosen);
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

  // Return the ms until the next moment: real time where time passes, else longer for short replays.
  function pause() {
    const here = at(position), next = at(position + 1);
    const passed = here.scene === next.scene ? next.yours.time - here.yours.time : 0;
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

  function toParting(to) {
    if (partAt === null) return;
    if (timer !== null) stop();
    if (replay.parting.body) chosen = replay.parting.body;
    go(to);
  }
  const toSeen = () => toParting(seenAt < 0 ? partAt : seenAt);
  const toLargest = () => toParting(seenAt < 0 ? partAt : largestAt);

  function nextBody() {
    const now = at(position), all = [...now.yours.bodies.keys()];
    if (all.length) chosen = all[(all.indexOf(chosen) + 1) % all.length];
    show();
  }

  // ---------------------------------------------------------------- input

  const KEYS = {
    " ": toggle, ArrowLeft: () => step(-1), ArrowRight: () => step(1),
    Home: () => step(-count), End: () => step(count), p: toSeen, P: toSeen, l: toLargest, L: toLargest, b: nextBody, B: nextBody,
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
  byId("part").addEventListener("click", toSeen);
  byId("largest").addEventListener("click", toLargest);
  slider.addEventListener("input", () => {
    if (timer !== null) stop();
    go(Number(slider.value));
  });

  const pick = (event) => {
    const now = at(position);
    if (now.scene.curve) return;
    const { x, y, px } = stage.place(event);
    let best = Infinity, found = null;
    for (const [moment, looks] of [[now.yours, now.scene.looks], [now.expected, now.scene.expected_looks]]) {
      for (const [number, state] of moment?.bodies ?? []) {
        const look = looks[number];
        if (!look || !stage.isFinitePlace(state)) continue;
        const away = Math.hypot(state[0] - x, state[1] - y);
        if (away < best && away < stage.reach(look) + 6 * px && (look.mass !== null || stage.reach(look) < 60)) [best, found] = [away, number];
      }
    }
    if (found !== null && found !== chosen) {
      chosen = found;
      show();
    }
  };
  for (const kind of ["pointermove", "pointerdown"]) canvas.addEventListener(kind, pick); // also a tap

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
  replay.scenes.forEach((scene, number) => {
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
  if (replay.parting) {
    const visible = seenAt < 0
      ? replay.parting.body ? " The difference is too small to see." : ""
      : ` You can see it from moment ${seenAt + 1} on; it is largest in moment ${largestAt + 1}.`;
    words.textContent = `The runs differ from moment ${partAt + 1} of ${count} on: ${replay.parting.words}.${visible}`;
    words.className = "parting apart";
    const mark = byId("mark"), share = count > 1 ? position / (count - 1) : 0;
    mark.hidden = false;
    mark.style.left = `calc(${100 * share}% + ${0.5 - share}rem)`;
  } else {
    words.textContent = replay.note || (replay.compared
      ? "There is no visible difference: it is in the numbers named above."
      : "Your run alone: the right run is not known here.");
  }
  byId("key-expected").hidden = !replay.compared;
  for (const each of document.querySelectorAll(".right")) each.hidden = !replay.compared;
  byId("part").disabled = byId("largest").disabled = partAt === null;
  slider.max = count - 1;
  if (window !== window.top) document.body.className = "framed";
  stage.readColours();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    stage.readColours();
    stage.draw(at(position), chosen);
  });
  new ResizeObserver(() => {
    for (const scene of replay.scenes) scene.arrows = undefined;
    stage.draw(at(position), chosen);
  }).observe(canvas.parentElement);
  show();
})();
