// What a step costs with the effects that are declared, as it was measured.
"use strict";

touch.figure("effects-stacked", (figure) => {
  const COLORS = ["fixed", "blue", "orange", "green", "red", "grey"]; // neighbours differ
  const NEEDS = { friction: "contacts", bounce: "contacts", "10 bullets, slow": "contacts" };
  const sizes = Object.keys(measured.prices);
  const balls = figure.slider("balls", {
    min: 0,
    max: sizes.length - 1,
    step: 1,
    value: 1,
    show: (place) => `${sizes[place]} balls`,
  });
  const titles = Object.keys(measured.prices[sizes[0]]);
  const declared = {};
  const colorOf = (title) => COLORS[titles.indexOf(title) % COLORS.length];
  for (const title of titles.slice(1)) declared[title] = figure.tick(title, true, colorOf(title));
  let read = titles[1]; // the piece whose price is told
  let pieces = [];

  figure.reading(
    (x) => {
      const under = pieces.find((piece) => piece.left <= x && x < piece.right);
      if (under) read = under.title;
    },
    (dx) => {
      const next = pieces[pieces.findIndex(({ title }) => title === read) + dx];
      if (next) read = next.title;
    },
  );

  const runs = (title) =>
    title === titles[0] || (declared[title].checked && (!NEEDS[title] || declared[NEEDS[title]].checked));

  figure.height = 150;
  return () => {
    for (const [title, needed] of Object.entries(NEEDS)) declared[title].disabled = !declared[needed].checked;
    const prices = measured.prices[sizes[balls.value]];
    const all = titles.reduce((sum, title) => sum + prices[title], 0);
    const kept = titles.filter(runs);
    const sum = kept.reduce((total, title) => total + prices[title], 0);
    const [left, width] = [10, figure.width - 20];
    let from = left;
    pieces = kept.map((title) => {
      const piece = { title, left: from, right: from + (width * prices[title]) / all };
      from = piece.right;
      return piece;
    });
    if (!kept.includes(read)) read = titles[0];
    figure.rect(left, 50, width, 44, "pale");
    for (const { title, left: start, right } of pieces) {
      figure.rect(start, 50, right - start, 44, colorOf(title));
    }
    const piece = pieces.find(({ title }) => title === read);
    figure.rect(piece.left, 46, Math.max(piece.right - piece.left, 2), 52, "none", "ink");
    const middle = (piece.left + piece.right) / 2;
    const anchor = middle < figure.width / 3 ? "start" : middle > (2 * figure.width) / 3 ? "end" : "middle";
    figure.text(middle, 38, `${read}: ${prices[read].toLocaleString("en")}`, { anchor, bold: true });
    figure.text(left, 124, `added up: ${sum.toLocaleString("en")} opcodes a step`);
    const share = (100 * prices[read]) / sum;
    figure.say(
      `With ${sizes[balls.value]} balls, the price of ${read} is ${prices[read].toLocaleString("en")} opcodes a step: ` +
        `${touch.number(share, share < 10 ? 1 : 0)} % of all that is declared.`,
    );
  };
});
