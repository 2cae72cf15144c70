/** Drawings that are drawn anew for every width, so that their letters have the same size on a phone, a screen and paper. */
const svg = (() => {
  const letters = 12;  // pixels
  const make = (parent, tag, attributes = {}, text) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, typeof value === "number" ? Math.round(100 * value) / 100 : value));
    if (text !== undefined) made.textContent = text;
    return parent.appendChild(made);
  };
  const widthOf = (text, size = letters) => 0.56 * size * String(text).length;

  /** Puts a drawing into a box of the page: draw(picture, width) gives its height. `paper` is its width in print, in pixels. */
  const place = (parent, about, paper, draw) => {
    const frame = parent.appendChild(element("div", "", { class: "drawn" }));
    let shown = 0;
    const show = width => {
      if (width < 50 || width === shown) return;
      shown = width;
      const picture = make(document.createDocumentFragment(), "svg", { role: "img", "aria-label": about, "font-size": letters, fill: "none", stroke: "#1d2530" });
      picture.setAttribute("viewBox", `0 0 ${width} ${Math.ceil(draw(picture, width))}`);
      frame.replaceChildren(picture);
    };
    const fit = () => show(frame.clientWidth);
    fit();
    new ResizeObserver(() => requestAnimationFrame(fit)).observe(frame);
    window.addEventListener("beforeprint", () => show(paper));
    window.addEventListener("afterprint", fit);
  };

  /** Writes texts beside points, where there is room: none lies on another or leaves the drawing. */
  const labels = (picture, width) => {
    const taken = [];
    const free = box => box.left >= 0 && box.right <= width && box.top >= 0 && taken.every(other => box.right < other.left || box.left > other.right || box.bottom < other.top || box.top > other.bottom);
    const boxAt = (text, x, y, size) => {
      const half = widthOf(text, size) / 2 + 1;
      return { left: x - half, right: x + half, top: y - 0.6 * size, bottom: y + 0.6 * size };
    };
    const write = (text, x, y, size, more) => {
      taken.push(boxAt(text, x, y, size));
      make(picture, "text", { x, y: y + 0.35 * size, "text-anchor": "middle", "font-size": size, fill: "#1d2530", stroke: "#fff", "stroke-width": 3, "paint-order": "stroke", ...more }, text);
    };
    return {
      /** Centred there, whatever is in the way but the drawing's edges. */
      at(text, x, y, size = letters, more = {}) {
        const half = widthOf(text, size) / 2 + 1;
        write(text, Math.max(half, Math.min(width - half, x)), y, size, more);
      },
      /** Near a point, if there is room to the side of (dx, dy). */
      beside(text, x, y, dx, dy, size = letters, more = {}) {
        const first = Math.atan2(dy, dx);
        for (const away of [size, 1.6 * size, 2.4 * size, 3.4 * size, 4.6 * size, 6 * size])
          for (const turn of [0, 0.5, -0.5, 1, -1, 1.6, -1.6, 2.3, -2.3, Math.PI]) {
            const cos = Math.cos(first + turn), sin = Math.sin(first + turn), half = widthOf(text, size) / 2;
            const at = [x + cos * (away + Math.max(0, half - size / 2) * Math.abs(cos)), y + sin * away];
            if (!free(boxAt(text, ...at, size))) continue;
            if (away > 1.6 * size) make(picture, "line", { x1: x, y1: y, x2: at[0], y2: at[1], "stroke-width": 0.6, stroke: "#5b6673" });
            return write(text, ...at, size, more);
          }
      },
      keepOff(left, top, right, bottom) { taken.push({ left, top, right, bottom }); },
    };
  };

  const arrow = (picture, x1, y1, x2, y2, more = {}) => {
    const length = Math.hypot(x2 - x1, y2 - y1);
    if (length < 0.5) return null;
    const group = make(picture, "g", more), [u, v] = [(x2 - x1) / length, (y2 - y1) / length], head = Math.min(8, 0.6 * length);
    make(group, "line", { x1, y1, x2: x2 - 0.6 * head * u, y2: y2 - 0.6 * head * v, "stroke-width": 1.8 });
    make(group, "path", { d: `M${x2},${y2} L${x2 - head * u + 0.4 * head * v},${y2 - head * v - 0.4 * head * u} L${x2 - head * u - 0.4 * head * v},${y2 - head * v + 0.4 * head * u} Z`, fill: more.stroke ?? "#1d2530", stroke: "none" });
    return group;
  };
  return { letters, make, widthOf, place, labels, arrow };
})();
