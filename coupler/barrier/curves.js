/** Curves over time in one chart, with the instants that the rules speak of. */
const drawCurves = (() => {
  const line = svg.letters + 4;
  /** Round values that cover a range, some five of them. */
  const ticks = (low, high, most) => {
    const rough = (high - low) / most || 1, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map(factor => factor * power).find(size => size >= rough * 0.999);
    const found = [];
    for (let k = Math.floor(low / step + 1e-9); k * step <= high + step * (1 - 1e-9); ++k) found.push(Number((k * step).toPrecision(8)));
    if (found.length < 2) found.push(found[0] + step);
    return found;
  };

  /** {title, unit, times, curves: [{label, values}], marks: [{time, text}]}; where nothing was measured a sentence says so. */
  return (parent, { title, unit, times, curves, marks = [] }) => {
    const frame = parent.appendChild(element("figure", "", { class: "curves" }));
    const measured = curves.filter(({ values }) => values?.some(value => typeof value === "number"));
    const shown = units.suited(unit, units.sizeOf(measured.flatMap(({ values }) => values.filter(value => value !== null))));
    frame.appendChild(element("figcaption", `${title}${measured.length && shown.unit ? ` (${shown.unit})` : ""}`));
    if (!measured.length || !(times?.length > 1)) return frame.appendChild(element("p", "Not measured."));
    const read = frame.appendChild(element("p", "", { class: "read" }));
    const legend = () => {
      read.replaceChildren(...measured.length > 1 ? measured.map(({ label }, i) => element("span", label, { style: `border-color: ${colours[i]}` })) : []);
      if (measured.length === 1) read.textContent = "\u00a0";
    };
    legend();
    const values = measured.flatMap(curve => curve.values.filter(value => value !== null)).map(value => shown.factor * value);
    const left = times[0], right = times.at(-1);

    svg.place(frame, title + " over time", 335, (picture, width) => {
      const height = Math.min(260, Math.max(170, 0.5 * width)), rows = ticks(Math.min(0, ...values), Math.max(0, ...values), 5), columns = ticks(left, right, width / 80).filter(time => time <= right * 1.0001);
      const margin = { left: 8 + Math.max(...rows.map(value => svg.widthOf(number(value)))), right: 14, top: line * Math.min(marks.length, 2) + 4, bottom: 2.2 * line };
      const x = time => margin.left + (time - left) / (right - left) * (width - margin.left - margin.right);
      const y = value => height - margin.bottom - (value - rows[0]) / (rows.at(-1) - rows[0]) * (height - margin.top - margin.bottom);
      const text = (content, at, down, anchor) => svg.make(picture, "text", { x: at, y: down, "text-anchor": anchor, fill: "#5b6673", stroke: "none" }, content);
      rows.forEach(value => {
        svg.make(picture, "line", { x1: margin.left, x2: width - margin.right, y1: y(value), y2: y(value), stroke: value === 0 ? "#5b6673" : "#d9dee5" });
        text(number(value), margin.left - 5, y(value) + 4, "end");
      });
      columns.forEach(time => {
        svg.make(picture, "line", { x1: x(time), x2: x(time), y1: y(rows[0]), y2: y(rows[0]) + 4, stroke: "#5b6673" });
        text(number(time), x(time), height - margin.bottom + line, "middle");
      });
      text("time (s)", margin.left + (width - margin.left - margin.right) / 2, height - 4, "middle");
      marks.filter(({ time }) => time !== null && time !== undefined && time >= left && time <= right).forEach(({ time, text: content }, row) => {
        const down = line * (row % 2 + 1) - 4, room = svg.widthOf(content), before = x(time) + room > width - 4;
        svg.make(picture, "line", { x1: x(time), x2: x(time), y1: down + 3, y2: y(rows[0]), stroke: "#5b6673", "stroke-dasharray": "4 3" });
        text(content, Math.max(2, x(time) - 3), down, before ? "end" : "start");
      });
      measured.forEach((curve, i) => {
        let pen = "M";
        const path = curve.values.map((value, k) => {
          if (value === null) { pen = "M"; return ""; }
          const step = `${pen}${x(times[k]).toFixed(1)},${y(shown.factor * value).toFixed(1)}`;
          pen = "L";
          return step;
        }).join("");
        svg.make(picture, "path", { d: path, stroke: colours[i], "stroke-width": i ? 1.8 : 1.3, "stroke-linejoin": "round", class: "curve" });
      });
      const cursor = svg.make(picture, "line", { y1: margin.top, y2: y(rows[0]), x1: -9, x2: -9, stroke: "#1d2530" });
      picture.addEventListener("pointermove", event => {
        const box = picture.getBoundingClientRect(), wanted = left + ((event.clientX - box.left) * width / box.width - margin.left) / (width - margin.left - margin.right) * (right - left);
        const nearest = times.reduce((best, time, k) => Math.abs(time - wanted) < Math.abs(times[best] - wanted) ? k : best, 0);
        cursor.setAttribute("x1", x(times[nearest]));
        cursor.setAttribute("x2", x(times[nearest]));
        const said = measured.map(({ label, values: all }) => `${measured.length > 1 ? label + " " : ""}${all[nearest] === null ? sizes.unknown : number(shown.factor * all[nearest]) + " " + shown.unit}`);
        read.textContent = `${number(times[nearest])} s: ${said.join(", ")}`;
      });
      picture.addEventListener("pointerleave", () => { legend(); ["x1", "x2"].forEach(name => cursor.setAttribute(name, -9)); });
      return height;
    });
    return frame;
  };
})();
