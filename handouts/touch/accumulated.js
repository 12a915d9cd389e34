// Four passes over a contact: the total clamped, and each change clamped.
"use strict";

touch.figure("accumulated", (figure) => {
  const asked = [10, -4, 1, -3].map((value, n) =>
    figure.slider(`pass ${n + 1} asks for`, { min: -10, max: 10, step: 1, value, show: signed }),
  );
  figure.height = 272;

  return () => {
    let [total, sum, free] = [0, 0, 0];
    const rows = asked.map(({ value }) => {
      const before = total;
      total = Math.max(total + value, 0);
      sum += Math.max(value, 0);
      free += value;
      return { total: [total, total - before], sum: [sum, Math.max(value, 0)] };
    });
    const most = Math.max(10, ...rows.map((row) => row.sum[0]));
    const [margin, half] = [42, (figure.width - 42) / 2];
    for (const [words, y] of [["jn", 200], ["asks", 226], ["gets", 244]]) figure.text(4, y, words, { color: "grey", size: 12 });
    const sides = [["clamp the total", "total", margin], ["clamp each change", "sum", margin + half]];
    for (const [title, key, left] of sides) {
      const room = (half - 8) / rows.length;
      figure.text(left, 20, title, { bold: true, size: figure.width < 420 ? 13 : 14 });
      rows.forEach((row, n) => {
        const [jn, change] = row[key];
        const high = (140 * jn) / most;
        const x = left + n * room;
        const middle = { anchor: "middle" };
        figure.rect(x, 206 - high, room - 10, high, jn === row.total[0] ? "green" : "red");
        figure.text(x + (room - 10) / 2, 200 - high, `${jn}`, middle);
        figure.text(x + (room - 10) / 2, 226, signed(asked[n].value), { ...middle, color: "grey", size: 12 });
        const own = change === asked[n].value ? { color: "grey" } : { color: "red", bold: true };
        figure.text(x + (room - 10) / 2, 244, signed(change), { ...middle, ...own, size: 12 });
      });
      figure.line([{ x: left - 4, y: 206 }, { x: left + half - 14, y: 206 }], "grey", 1);
    }
    const [right, given] = [rows.at(-1).total[0], rows.at(-1).sum[0]];
    const extra = given - right;
    figure.say(
      extra > 0
        ? `All passes together ask for ${signed(free)}. Clamping each change gives ${given}: ${extra} too much, which no later pass can take back.`
        : `All passes together ask for ${signed(free)}. Both rules give ${right}: nothing had to be taken back.`,
    );
  };

  function signed(value) {
    return value > 0 ? `+${value}` : `${value}`.replace("-", "\u2212");
  }
});
