// The lab on one page: a TODO at a time with its text, its code, its window and its check.
import { Editor } from "./editor.js";
import { Python } from "./python.js";
import { Stage } from "./stage.js";
import { keep, read } from "./store.js";

const $ = (id) => document.getElementById(id);
const SAVE_MS = 300; // after the last key
const SILENT_MS = 3000; // without a picture, until we say how to stop
const MOST_PRINTED = 30_000; // characters on the page
const LETTER = 7.9, MARGINS = 52; // px of a column of the check's text, and left and right of it

let lab, given, files = {}, todo, shown, states = {}, saving; // `shown` is the file in the editor
const python = new Python(hear);
const stage = new Stage($("window"), (...event) => python.send(...event));
const editor = new Editor($("editor"), edit);

// ---------------------------------------------------------------- the work

const textOf = (name) => files[name] ?? given[name] ?? "";

function edit(text) {
  files[shown] = text;
  clearTimeout(saving);
  saving = setTimeout(save, SAVE_MS);
}

function save() {
  clearTimeout(saving);
  saving = undefined;
  for (const name of Object.keys(files)) if (files[name] === given[name]) delete files[name];
  return keep("work", { files, todo: todo.id, states }).catch((error) =>
    say(`This browser does not keep your work (${error.message}): use Export before you leave.`));
}

function choose(id) {
  if (todo && !python.busy) hideResult();
  todo = lab.todos.find((each) => each.id === id) ?? lab.todos[0];
  $("todo").value = todo.id;
  $("title").textContent = `TODO ${todo.id}: ${todo.title}`;
  $("text").innerHTML = todo.text; // of the lab sheet, made with the page
  $("back").disabled = todo === lab.todos[0];
  $("next").disabled = todo === lab.todos.at(-1);
  $("hints").replaceChildren();
  showHintButton();
  showFiles();
  open(todo.file);
  $("task").scrollTop = 0;
  save();
}

// Take away what another TODO's program and check have left.
function hideResult() {
  for (const name of ["found", "replay", "screen"]) $(name).hidden = true;
  $("printed").textContent = "";
  say("");
}

// Open a file: that of the TODO at its region, another one whole.
function open(name) {
  shown = $("file").value = name;
  $("whole").disabled = name !== todo.file;
  showFolded(name === todo.file);
  editor.show(textOf(name), todo.id);
}

// Offer the files of the TODO's program, and those beside it.
function showFiles() {
  const [top, inside] = todo.file.split("/");
  const isProgram = (name) => name === todo.file || (inside && name.startsWith(`${top}/`));
  const names = Object.keys({ ...given, ...files }).filter((name) =>
    name.endsWith(".py") && (!name.includes("/") || isProgram(name)));
  $("file").replaceChildren(...names.sort().map((name) => new Option(name)));
  showLetters(names.filter(isProgram));
}

// Offer the letters that a program with these files listens to, for who has no keyboard.
function showLetters(names) {
  const bonus = todo.file.includes("/bonus/");
  const text = names.filter((name) => bonus || !name.includes("/bonus/")).map(textOf).join();
  const letters = new Set([...text.matchAll(/\bK_([a-z])\b/g)].map(([, letter]) => letter));
  for (const button of document.querySelectorAll("[data-letter]")) {
    button.hidden = !letters.has(button.dataset.key);
  }
}

function step(by) {
  choose(lab.todos[lab.todos.indexOf(todo) + by].id);
}

function showHintButton() {
  const left = todo.hints.length - $("hints").children.length;
  $("hint").disabled = left === 0;
  $("hint").textContent = $("hints").children.length && left ? "Next hint" : "Hint";
}

function showFolded(folded) {
  $("whole").setAttribute("aria-pressed", String(!folded));
}

function showStates() {
  for (const option of $("todo").options) {
    const each = lab.todos.find(({ id }) => id === option.value), state = states[each.id];
    option.textContent = `TODO ${each.id}: ${each.title}` + (state ? ` (${state[0]})` : "");
  }
}

// ---------------------------------------------------------------- Python

function hear(message) {
  if (message.kind === "picture") showPicture(message);
  if (message.kind === "told") say(`Checked: ${message.title}`);
  if (message.kind === "printed" && $("printed").textContent.length < MOST_PRINTED) {
    $("printed").textContent += message.text;
  }
}

// A program without a window shows none: it opens with the first picture.
function showPicture(message) {
  if (stage.pictures === 0) {
    $("screen").hidden = false;
    $("window").focus();
  }
  stage.take(message);
}

const say = (text) => ($("status").textContent = text);

// Ask Python with the present files, while only Stop can be pressed.
async function ask(message, doing) {
  setBusy(true);
  say(doing);
  await save();
  let stubborn = false;
  $("stop").onclick = async () => {
    say("Stopping …");
    stubborn = !(await python.stop());
  };
  const answer = await python.ask({ files, ...message });
  if (answer.failed && /KeyboardInterrupt|Stopped/.test(answer.failed)) answer.failed = "Stopped.";
  say(answer.failed ?? "");
  if (stubborn) await boot();
  setBusy(false);
  return answer.failed ? null : answer;
}

function setBusy(busy) {
  for (const button of document.querySelectorAll("[data-needs-python]")) button.disabled = busy;
  $("stop").disabled = !busy;
}

async function boot() {
  say("Starting Python …");
  setBusy(true);
  $("stop").disabled = true;
  const began = performance.now();
  const answer = await python.start();
  if (answer.failed) return say(`Python does not start: ${answer.failed}`);
  document.body.dataset.ready = Math.round(performance.now() - began);
  document.body.dataset.boots = Number(document.body.dataset.boots ?? 0) + 1;
  say(`Ready. ${lab.note}`);
  setBusy(false);
}

async function run() {
  $("printed").textContent = "";
  $("screen").hidden = true;
  stage.pictures = 0;
  const began = performance.now();
  let seen = -1;
  const silent = setInterval(() => {
    if (seen === stage.pictures) say("Nothing new to see for 3 s. If your loop never ends: Stop.");
    seen = stage.pictures;
  }, SILENT_MS);
  const answer = await ask({ kind: "run", module: todo.program }, `Running ${todo.program}. Stop ends it.`);
  clearInterval(silent);
  document.body.dataset.pictures = stage.pictures;
  document.body.dataset.ran = Math.round(performance.now() - began);
  if (!answer) return;
  $("printed").textContent += answer.error;
  say(answer.error ? "The program ended with an error, see below." : "The program has ended.");
}

async function check(only) {
  $("replay").hidden = true;
  const columns = Math.floor(($("result").clientWidth - MARGINS) / LETTER);
  const answer = await ask({ kind: "check", only, columns }, "Checking …");
  if (!answer) return;
  const { lines, todos, replays } = JSON.parse(answer.found);
  for (const [id, state, points, most] of todos) states[id] = [state, points, most];
  showStates();
  $("found").replaceChildren(...lines.map(([text, style]) => {
    const line = document.createElement("div");
    line.textContent = text || " ";
    line.className = style;
    return line;
  }));
  $("found").hidden = false;
  $("found").scrollIntoView({ block: "nearest" });
  const own = states[todo.id];
  say(only.length && own ? `TODO ${todo.id}: ${own[0]}, ${own[1]} of ${own[2]} points.` : "Checked.");
  save();
  $("replays").replaceChildren(...replays.map(([id, check, title]) => new Option(title, JSON.stringify([id, check]))));
  showReplay();
}

// Show the chosen replay. A check without one leaves the menu, and the next is taken.
async function showReplay() {
  const menu = $("replays"), asked = menu.value;
  if (!asked) return ($("replay").hidden = true);
  const [id, check] = JSON.parse(asked);
  const { page } = await python.ask({ kind: "replay", todo: id, check });
  if (menu.value !== asked) return; // another check has come since
  if (!page) {
    menu.selectedOptions[0].remove();
    return showReplay();
  }
  $("player").title = `Replay of ${menu.selectedOptions[0].text}`;
  $("player").srcdoc = page;
  $("replay").hidden = false;
}

// Make the frame as high as its page, so that there is one scroll bar.
function fitPlayer() {
  const inside = $("player").contentDocument.documentElement;
  new ResizeObserver(() => ($("player").style.height = `${inside.offsetHeight}px`)).observe(inside);
}

// ---------------------------------------------------------------- files in and out

function download(data, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([data], { type: "application/zip" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

async function handIn() {
  const answer = await ask({ kind: "handIn" }, "Packing …");
  if (!answer) return;
  download(answer.zip, "hand-in.zip");
  $("printed").textContent = answer.said;
  say("hand-in.zip is in your downloads: hand in this one file.");
}

async function exportAll() {
  const answer = await ask({ kind: "export" }, "Packing …");
  if (!answer) return;
  download(answer.zip, "physics-engine.zip");
  say("physics-engine.zip is in your downloads: your folder as it is.");
}

async function bringIn(file) {
  const data = await file.arrayBuffer();
  const answer = await ask({ kind: "bringIn", data, name: file.name }, "Reading …");
  if (!answer) return;
  const texts = JSON.parse(answer.files);
  Object.assign(files, texts);
  choose(todo.id);
  say(`Read ${Object.keys(texts).join(", ")}.`);
}

function startOver() {
  const name = shown;
  if (!confirm(`Put ${name} back as it was handed out? All that you wrote in it is lost.`)) return;
  delete files[name];
  save();
  open(name);
  say(`${name} is as it was handed out.`);
}

// ---------------------------------------------------------------- the page

// Memory is shared on isolated pages only; the service worker makes this one isolated, and keeps it
// for use offline. The first visit loads the page again once it is there.
async function isolate() {
  if (!("serviceWorker" in navigator)) {
    throw new Error("this browser, or this address, does not allow it: the page needs https:// or localhost");
  }
  const registered = navigator.serviceWorker.register("./sw.js");
  if (crossOriginIsolated) return;
  say("Loading Python, about 8 MB. Read the text meanwhile …");
  await registered;
  await navigator.serviceWorker.ready;
  if (sessionStorage.getItem("loaded-again")) {
    throw new Error("this browser does not share memory: take a newer Firefox, Chrome, Edge or Safari");
  }
  sessionStorage.setItem("loaded-again", "yes");
  if (saving) await save();
  location.reload();
  await new Promise(() => {});
}

function connect() {
  $("todo").onchange = () => choose($("todo").value);
  $("back").onclick = () => step(-1);
  $("next").onclick = () => step(1);
  $("hint").onclick = () => {
    const hint = document.createElement("li");
    hint.textContent = todo.hints[$("hints").children.length];
    $("hints").append(hint);
    showHintButton();
  };
  $("whole").onclick = () => {
    const folded = $("whole").getAttribute("aria-pressed") === "true";
    folded ? editor.fold() : editor.unfold();
    showFolded(folded);
  };
  $("file").onchange = () => open($("file").value);
  $("run").onclick = run;
  $("check").onclick = () => check([todo.id]);
  $("check-all").onclick = () => check([]);
  $("hand-in").onclick = handIn;
  $("export").onclick = exportAll;
  $("import").onclick = () => $("chosen").click();
  $("chosen").onchange = ({ target }) => target.files[0] && bringIn(target.files[0]);
  $("start-over").onclick = startOver;
  $("replays").onchange = showReplay;
  $("player").onload = fitPlayer;
  for (const button of document.querySelectorAll("[data-key]")) {
    button.onclick = () => stage.type(button.dataset.key);
  }
  addEventListener("keydown", (event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      $(event.shiftKey ? "run" : "check").click();
    }
  }, true);
  addEventListener("pagehide", () => saving && save());
}

async function main() {
  try {
    const isolated = isolate();
    isolated.catch(() => {}); // told below
    lab = await (await fetch("./lab.json")).json();
    given = lab.files;
    const kept = await read("work").catch(() => undefined);
    ({ files = {}, states = {} } = kept ?? {});
    document.title = $("course").textContent = lab.title;
    $("todo").replaceChildren(...lab.todos.map(({ id }) => new Option(id, id)));
    showStates();
    connect();
    choose(kept?.todo);
    await isolated;
    document.body.dataset.shown = "yes";
    await boot();
    (await navigator.serviceWorker.ready).active.postMessage("keep all");
  } catch (error) {
    say(`The page does not start: ${error.message}`);
  }
}

main();
