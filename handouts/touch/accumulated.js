// Four passes over a contact: the total clamped, and each change clamped.
"use strict";

touch.figure("accumulated", (figure) => {
  const asked = [10, -4, 1, -3].map((value, n) =>
    figure.slider(`pass ${n + 1} asks for`, { min: -10, max: 10, step: 1, value, show: signed }),
  );
  figure.height = 250;

  return () => {
    let [total, sum, free] = [0, 0, 0];
    const rows = asked.map(({ value }) => {
      total = Math.max(total + value, 0);
      sum += Math.max(value, 0);
      free += value;
      return { total, sum, free };
    });
    const most = Math.max(10, ...rows.map((row) => row.sum));
    const half = figure.width / 2;
    const sides = [["clamp the total", "total", 8], ["clamp each change", "sum", half + 8]];
    for (const [title, key, left] of sides) {
      const room = (half - 16) / rows.length;
      figure.text(left, 20, title, { bold: true });
      rows.forEach((row, n) => {
        const high = (150 * row[key]) / most;
        const x = left + n * room;
        const right = row[key] === row.total;
        figure.rect(x, 210 - high, room - 10, high, right ? "green" : "red");
        figure.text(x + (room - 10) / 2, 204 - high, `${row[key]}`, { anchor: "middle" });
        figure.text(x + (room - 10) / 2, 230, signed(asked[n].value), {
          anchor: "middle",
          color: "grey",
        });
      });
      figure.line([{ x: left - 4, y: 210 }, { x: left + half - 20, y: 210 }], "grey", 1);
    }
    const last = rows.at(-1);
    const extra = last.sum - last.total;
    figure.say(
      extra > 0
        ? `All passes together ask for ${signed(last.free)}. Clamping each change gives ${last.sum}: ${extra} too much, which no later pass can take back.`
        : `All passes together ask for ${signed(last.free)}. Both rules give ${last.total}: nothing had to be taken back.`,
    );
  };

  function signed(value) {
    return value > 0 ? `+${value}` : `${value}`.replace("-", "\u2212");
  }
});
