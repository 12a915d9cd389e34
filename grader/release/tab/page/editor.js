// The editor: a whole file, of which the function around one TODO is shown and the rest is folded.
import { autocompletion } from "@codemirror/autocomplete";
import { indentWithTab } from "@codemirror/commands";
import { python } from "@codemirror/lang-python";
import { HighlightStyle, codeFolding, foldEffect, indentUnit, syntaxHighlighting, unfoldAll }
  from "@codemirror/language";
import { EditorState } from "@codemirror/state";
import { Decoration, EditorView, keymap } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { basicSetup } from "codemirror";

const colours = HighlightStyle.define([
  { tag: tags.keyword, color: "var(--keyword)" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--string)" },
  { tag: tags.comment, color: "var(--comment)", fontStyle: "italic" },
  { tag: tags.number, color: "var(--number)" },
]);

export class Editor {
  constructor(parent, changed) {
    this.view = new EditorView({ parent });
    this.changed = changed;
  }

  // Show the region of a TODO in a file's text.
  show(text, id) {
    this.id = id;
    this.view.setState(EditorState.create({
      doc: text,
      extensions: [
        basicSetup, autocompletion({ activateOnTyping: false }), python(), indentUnit.of("    "), codeFolding(),
        EditorView.lineWrapping,
        keymap.of([indentWithTab]), syntaxHighlighting(colours),
        EditorView.contentAttributes.of({
          tabindex: "0", "aria-label": `Code of TODO ${id}. Escape, then Tab leaves it.`,
        }),
        EditorView.decorations.compute(["doc"], (state) => markRegion(state.doc, id)),
        EditorView.updateListener.of((update) => {
          if (update.docChanged) this.changed(update.state.doc.toString());
        }),
      ],
    }));
    this.fold();
  }

  fold() {
    const { doc } = this.view.state, region = findRegion(doc, this.id);
    if (!region) return;
    const effects = foldsAround(doc, region).map((range) => foldEffect.of(range));
    const first = doc.line(Math.min(region.first + 1, doc.lines));
    this.view.dispatch({ effects, selection: { anchor: first.to } });
    this.view.dispatch({ effects: EditorView.scrollIntoView(doc.line(region.first).from, { y: "center" }) });
  }

  unfold() {
    unfoldAll(this.view);
  }
}

// Return the numbers of the lines with a TODO's two markers.
export function findRegion(doc, id) {
  const begins = new RegExp(`^\\s*# TODO ${id}:`), ends = new RegExp(`^\\s*# END TODO ${id}\\b`);
  let first = 0;
  for (let number = 1; number <= doc.lines; number++) {
    const { text } = doc.line(number);
    if (begins.test(text)) first = number;
    if (first && ends.test(text)) return { first, last: number };
  }
  return null;
}

function markRegion(doc, id) {
  const region = findRegion(doc, id), marks = [];
  for (let number = region?.first; number <= region?.last; number++) {
    marks.push(Decoration.line({ class: "region" }).range(doc.line(number).from));
  }
  return Decoration.set(marks);
}

// Return what to fold: all before the function, and all behind it.
function foldsAround(doc, { first, last }) {
  let head = first;
  while (head > 1 && !/^\s*(def|class) /.test(doc.line(head).text)) head--;
  const depth = doc.line(head).text.search(/\S/);
  let end = last;
  while (end < doc.lines && !startsAnother(doc.line(end + 1).text, depth)) end++;
  while (end > last && !doc.line(end).text.trim()) end--;
  const folds = [{ from: 0, to: doc.line(head).from - 1 }, { from: doc.line(end).to, to: doc.length }];
  return folds.filter(({ from, to }) => to - from > 1);
}

const startsAnother = (text, depth) => text.trim() !== "" && text.search(/\S/) <= depth;
