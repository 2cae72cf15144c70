/** The barrier from the front, from the side and from above, to scale, with its dimensions; and the forces on its anchors. */
const drawing = (() => {
  const ink = { ground: "#8b7a5c", post: "#1d2530", support: "#1f6fb2", retaining: "#d1642c", lateral: "#8a4fbf", net: "#2e8b57", block: "#8d7b68", size: "#5b6673", force: "#b3261e" };
  const line = svg.letters + 4;
  const metres = value => sizes.of("m", value);
  const angle = value => value * Math.PI / 180;

  const isPoint = point => Array.isArray(point) && point.length === 3 && point.every(Number.isFinite);

  /** The layout's parts as lists of points, whatever of it is there. */
  const partsOf = layout => {
    const list = name => layout[name]?.every(isPoint) ? layout[name] : [];
    const feet = list("feet"), heads = list("heads"), retaining = list("retaining_anchors"), parts = [];
    const add = (kind, ...points) => { if (points.length > 1 && points.every(Boolean)) parts.push({ kind, points }); };
    const net = layout.net;
    if (isPoint(net?.corner) && isPoint(net.up) && net.length && net.height) {
      const corners = [[0, 0], [net.length, 0], [net.length, net.height], [0, net.height]].map(([along, across]) => [0, 1, 2].map(k => net.corner[k] + (k === 0 ? along : 0) + across * net.up[k]));
      add("net", ...corners, corners[0]);
    }
    heads.forEach((head, k) => [retaining[k], retaining[k + 1]].forEach(anchor => add("retaining", head, anchor)));
    const [west, east] = list("lateral_anchors");
    if (heads.length) [[west, heads[0]], [east, heads.at(-1)]].forEach(([anchor, head]) => add("lateral", anchor, head));
    [["upper", heads], ["lower", feet]].forEach(([name, through]) => {
      const [first, last] = list(name + "_anchors"), [begin, end] = list(name + "_ends");
      if (through.length) add("support", ...[first, begin, ...through, end, last].filter(Boolean));
    });
    feet.forEach((foot, k) => add("post", foot, heads[k]));
    return { parts, feet, heads, retaining, lateral: list("lateral_anchors"), anchors: [...retaining, ...["lateral_anchors", "upper_anchors", "lower_anchors"].flatMap(list)] };
  };

  /** From metres to the picture: across and up of the view, what it shows, and the room around it in pixels. */
  const scaled = (points, view, width, room, most = 1e9) => {
    const seen = points.map(view), low = [0, 1].map(k => Math.min(...seen.map(point => point[k]))), high = [0, 1].map(k => Math.max(...seen.map(point => point[k])));
    const scale = Math.min((width - room.left - room.right) / (high[0] - low[0] || 1), most / (high[1] - low[1] || 1));
    const slack = (width - room.left - room.right - scale * (high[0] - low[0])) / 2;
    const flat = ([across, up]) => [room.left + slack + scale * (across - low[0]), room.top + scale * (high[1] - up)];
    return { scale, low, high, flat, at: point => flat(view(point)), height: room.top + scale * (high[1] - low[1]) + room.bottom, bottom: room.top + scale * (high[1] - low[1]) };
  };

  const drawParts = (picture, parts, at) => parts.forEach(({ kind, points }) => svg.make(picture, "polyline", {
    points: points.map(point => at(point).map(value => value.toFixed(1)).join(",")).join(" "), stroke: ink[kind], "stroke-linejoin": "round", class: kind,
    ...{ net: { "stroke-width": 0.7, fill: ink.net + "33" }, post: { "stroke-width": 3.5 }, retaining: { "stroke-width": 1 } }[kind] ?? { "stroke-width": 1.4 } }));
  const drawAnchors = (picture, anchors, at) => anchors.forEach(anchor => {
    const [x, y] = at(anchor);
    svg.make(picture, "rect", { x: x - 2.5, y: y - 2.5, width: 5, height: 5, fill: "#fff", "stroke-width": 1.2 });
  });
  /** The block is a cube with cut edges: from every side it is seen as a square without corners. */
  const drawBlock = (picture, layout, edge, { at, scale }, turned = 0) => {
    if (!isPoint(layout.block_centre) || !edge) return;
    const [x, y] = at(layout.block_centre), half = scale * edge / 2;
    const corners = [[1, 0.5], [0.5, 1], [-0.5, 1], [-1, 0.5], [-1, -0.5], [-0.5, -1], [0.5, -1], [1, -0.5]].map(([a, b]) =>
      [x + half * (a * Math.cos(turned) - b * Math.sin(turned)), y + half * (a * Math.sin(turned) + b * Math.cos(turned))].map(value => value.toFixed(1)).join(","));
    svg.make(picture, "polygon", { points: corners.join(" "), fill: ink.block, "fill-opacity": 0.75, "stroke-width": 1, class: "block" });
  };
  /** A chain of lengths along the row below a view. Lengths that are too short for their number leave it away. */
  const chain = (picture, text, places, at, down, from) => places.slice(1).forEach((to, k) => {
    const [a, b] = [at(places[k]), at(to)];
    if (b - a < 1) return;
    svg.make(picture, "line", { x1: a, x2: b, y1: down, y2: down, stroke: ink.size, "stroke-width": 0.8 });
    [a, b].forEach(x => {
      svg.make(picture, "line", { x1: x, x2: x, y1: from, y2: down + 4, stroke: ink.size, "stroke-width": 0.4 });
      svg.make(picture, "line", { x1: x - 3, x2: x + 3, y1: down + 3, y2: down - 3, stroke: ink.size });
    });
    const said = [metres(to - places[k]), number(to - places[k], 3)].find(words => svg.widthOf(words) < b - a + 4);
    if (said) text.at(said, (a + b) / 2, down + 9, svg.letters, { fill: ink.size });
  });
  /** The same upwards, beside a view. */
  const upright = (picture, text, from, to, at, across, begin, what) => {
    const [a, b] = [at(from), at(to)];
    svg.make(picture, "line", { x1: across, x2: across, y1: a, y2: b, stroke: ink.size, "stroke-width": 0.8 });
    [a, b].forEach(y => {
      svg.make(picture, "line", { x1: begin, x2: across + 4, y1: y, y2: y, stroke: ink.size, "stroke-width": 0.4 });
      svg.make(picture, "line", { x1: across - 3, x2: across + 3, y1: y + 3, y2: y - 3, stroke: ink.size });
    });
    text.beside(what ?? metres(to - from), across, (a + b) / 2, 1, 0, svg.letters, { fill: ink.size });
  };
  const groundLine = (picture, x1, x2, y) => {
    svg.make(picture, "line", { x1, x2, y1: y, y2: y, stroke: ink.ground, "stroke-width": 1.4 });
    for (let x = x1 + 2; x < x2; x += 9) svg.make(picture, "line", { x1: x, x2: x - 5, y1: y, y2: y + 5, stroke: ink.ground, "stroke-width": 0.5 });
  };
  const arc = (picture, [x, y], radius, from, to) => {
    const point = turn => `${(x + radius * Math.cos(turn)).toFixed(1)},${(y - radius * Math.sin(turn)).toFixed(1)}`;
    svg.make(picture, "path", { d: `M${point(from)} A${radius},${radius} 0 ${Math.abs(to - from) > Math.PI ? 1 : 0} ${to > from ? 0 : 1} ${point(to)}`, stroke: ink.size, "stroke-width": 0.9 });
  };

  /** x to the right, z up. */
  const front = (parent, data) => svg.place(parent, "The barrier from the front", 420, (picture, width) => {
    const layout = data.layout, { parts, feet, heads, lateral, anchors } = partsOf(layout), text = svg.labels(picture, width);
    const view = ([x, , z]) => [x, z], ground = anchors.length ? [] : [[0, 0, 0]];
    const map = scaled([...parts.flatMap(part => part.points), ...feet.map(([x, y]) => [x, y, 0]), ...anchors, ...ground], view, width, { left: 12, right: 62, top: 12, bottom: 2 * line + 22 }, 170);
    groundLine(picture, 2, width - 50, map.flat([0, 0])[1]);
    drawBlock(picture, layout, data.block?.edge_m, map);
    drawParts(picture, parts, map.at);
    drawAnchors(picture, anchors, map.at);
    const along = x => map.flat([x, 0])[0], rows = feet.map(foot => foot[0]), down = map.bottom + 12;
    chain(picture, text, [lateral[0]?.[0], ...rows, lateral[1]?.[0]].filter(sizes.known), along, down, map.bottom + 2);
    if (rows.length > 1) chain(picture, text, [rows[0], rows.at(-1)], along, down + line + 6, down);
    if (heads.length) upright(picture, text, 0, heads.at(-1)[2], z => map.flat([0, z])[1], width - 52, map.at(heads.at(-1))[0] + 4);
    return map.height;
  });

  /** x to the right, y (up the slope) up. */
  const plan = (parent, data) => svg.place(parent, "The barrier from above, seen along the normal of the slope", 420, (picture, width) => {
    const layout = data.layout, { parts, feet, retaining, anchors } = partsOf(layout), text = svg.labels(picture, width);
    const view = ([x, y]) => [x, y];
    const map = scaled([...parts.flatMap(part => part.points), ...anchors, [feet[0]?.[0] ?? 0, 0, 0]], view, width, { left: 12, right: 62, top: 10, bottom: line + 16 }, 170);
    drawParts(picture, parts, map.at);
    drawBlock(picture, layout, data.block?.edge_m, map);
    drawAnchors(picture, anchors, map.at);
    const along = x => map.flat([x, 0])[0];
    chain(picture, text, retaining.map(anchor => anchor[0]), along, map.bottom + 12, map.bottom + 2);
    if (retaining.length && feet.length) upright(picture, text, feet.at(-1)[1], retaining.at(-1)[1], y => map.flat([0, y])[1], width - 52, Math.max(along(retaining.at(-1)[0]), along(feet.at(-1)[0])) + 4);
    return map.height;
  });

  /** y (up the slope) to the right, z up: one post with its retaining rope, and where down is. */
  const side = (parent, data) => svg.place(parent, "The barrier from the side", 268, (picture, width) => {
    const layout = data.layout, { feet, heads, retaining, parts, anchors } = partsOf(layout), text = svg.labels(picture, width), edge = data.block?.edge_m ?? 0;
    const view = ([, y, z]) => [y, z], foot = feet[0], head = heads[0], anchor = retaining[0], block = isPoint(layout.block_centre) ? layout.block_centre : null;
    const corners = block ? [-1, 1].flatMap(a => [-1, 1].map(b => [0, block[1] + a * edge / 2, block[2] + b * edge / 2])) : [];
    const map = scaled([...parts.flatMap(part => part.points), ...corners, ...anchors, [0, -1.2, 0]], view, width, { left: 16, right: 22, top: 30, bottom: 96 }, 300);
    const ground = map.flat([0, 0])[1];
    groundLine(picture, 2, width - 2, ground);
    drawParts(picture, parts, map.at);
    if (block) drawBlock(picture, layout, edge, map, angle(layout.lean_deg ?? 0));
    drawAnchors(picture, anchors, map.at);
    if (block) text.keepOff(...map.at(block).map(value => value - 0.55 * edge * map.scale), ...map.at(block).map(value => value + 0.55 * edge * map.scale));
    if (foot && head) {
      const [fx, fy] = map.at(foot), [hx, hy] = map.at(head), length = Math.hypot(hx - fx, hy - fy), reach = 0.42 * length;
      svg.make(picture, "line", { x1: fx, x2: fx, y1: fy, y2: fy - 1.15 * reach, stroke: ink.size, "stroke-dasharray": "3 3", "stroke-width": 0.9 });
      const [u, v] = [(hx - fx) / length, (hy - fy) / length], post = Math.atan2(-v, u);
      arc(picture, [fx, fy], reach, post, Math.PI / 2);
      text.beside(sizes.degrees(layout.lean_deg), fx, fy - reach, -1, -0.3);
      const off = 14, ends = [[fx, fy], [hx, hy]].map(([x, y]) => [x + off * v, y - off * u]);
      svg.make(picture, "line", { x1: ends[0][0], y1: ends[0][1], x2: ends[1][0], y2: ends[1][1], stroke: ink.size, "stroke-width": 0.8 });
      ends.forEach(([x, y]) => svg.make(picture, "line", { x1: x - 3 * v, y1: y + 3 * u, x2: x + 3 * v, y2: y - 3 * u, stroke: ink.size }));
      text.beside(metres(layout.post_length), ends[1][0] * 0.8 + ends[0][0] * 0.2, ends[1][1] * 0.8 + ends[0][1] * 0.2, -1, -0.2);
      if (anchor) {
        const [ax, ay] = map.at(anchor), rope = Math.atan2(-(ay - hy), ax - hx), back = Math.atan2(-(fy - hy), fx - hx);
        const wide = Math.min(0.24 * length, 0.4 * Math.hypot(ax - hx, ay - hy)), middle = (rope + back) / 2;
        arc(picture, [hx, hy], wide, back, rope);
        text.beside(sizes.degrees(layout.retaining_angle_deg), hx + wide * Math.cos(middle), hy - wide * Math.sin(middle), Math.cos(middle), -Math.sin(middle));
        chain(picture, text, [foot[1], anchor[1]], y => map.flat([y, 0])[0], ground + 20, ground + 4);
      }
    }
    if (block) {
      const [bx, by] = map.at(block), half = map.scale * edge / 2;
      svg.arrow(picture, bx + half + 34, by, bx + half + 4, by, { stroke: ink.force, class: "speed" });
      text.beside(sizes.of("m/s", data.block?.speed_m_per_s), bx + half + 40, by, 1, 0);
      text.beside(sizes.of("m", edge || null, 4), bx, by + half + 2, 0.3, 1);
    }
    const slope = data.slope_deg;
    if (sizes.known(slope)) {
      // Level ground and the direction of gravity lie in this view as the slope turns them.
      const at = [Math.max(30, 0.16 * width), ground], turn = -angle(slope), reach = 66;
      svg.make(picture, "line", { x1: at[0], y1: at[1], x2: at[0] + reach * Math.cos(turn), y2: at[1] - reach * Math.sin(turn), stroke: ink.ground, "stroke-dasharray": "5 3" });
      arc(picture, at, 40, 0, turn);
      const half = turn / 2;
      text.beside(`slope ${sizes.degrees(slope)}`, at[0] + 40 * Math.cos(half), at[1] - 40 * Math.sin(half), Math.cos(half), -Math.sin(half));
      const start = [0.72 * width, ground + 52], down = [-Math.sin(angle(slope)), -Math.cos(angle(slope))];
      svg.arrow(picture, start[0] - 17 * down[0], start[1] + 17 * down[1], start[0] + 17 * down[0], start[1] - 17 * down[1], { class: "gravity" });
      text.beside("gravity", start[0], start[1] + (Math.abs(down[1]) > 0.7 ? 0 : 4), Math.abs(down[1]) > 0.7 ? 1 : 0, Math.abs(down[1]) > 0.7 ? 0 : 1);
    }
    return map.height;
  });

  const views = (parent, data) => {
    const whole = partsOf(data.layout ?? {});
    if (!whole.parts.length) return parent.appendChild(element("p", "There is no drawing: where the barrier's parts stand was not given."));
    const grid = parent.appendChild(element("div", "", { class: "views" }));
    const titled = (where, title, draw) => {
      const figure = where.appendChild(element("figure"));
      figure.appendChild(element("figcaption", title));
      draw(figure, data);
    };
    const rows = grid.appendChild(element("div")), beside = grid.appendChild(element("div"));
    titled(rows, "From the front: along the row, off the slope", front);
    titled(rows, "From above: along the row, up the slope", plan);
    titled(beside, "From the side: up the slope, off it", side);
    const legend = parent.appendChild(element("p", "", { class: "legend" }));
    [["post", "posts"], ["net", "net"], ["support", "support ropes"], ["retaining", "retaining ropes"], ["lateral", "lateral ropes"], ["block", "block"]]
      .forEach(([kind, name]) => legend.appendChild(element("span", name, { style: `border-color: ${ink[kind]}` })));
    legend.appendChild(element("span", "□ anchors", { class: "plain" }));
  };

  /** Forces on anchors as arrows in the plan; anchors with their number as in the table. */
  const forces = (parent, layout, anchors) => {
    const known = anchors.map((anchor, i) => ({ ...anchor, sign: String(i + 1) })).filter(({ at }) => isPoint(at));
    if (!known.length) return false;
    const inPlan = ({ force_N: force }) => isPoint(force) ? Math.hypot(force[0], force[1]) : 0;
    const largest = Math.max(...known.map(inPlan));
    svg.place(parent, "The forces on the anchors, from above", 690, (picture, width) => {
      const { parts } = partsOf(layout ?? {}), longest = Math.min(110, Math.max(45, 0.13 * width)), text = svg.labels(picture, width);
      const ring = known.map(({ at }) => at), view = ([x, y]) => [x, y];
      const vector = ({ force_N: force }) => isPoint(force) && largest > 0 ? [longest * force[0] / largest, -longest * force[1] / largest] : [0, 0];
      const room = { left: 26, right: 26, top: 24, bottom: 24 + line };
      let map = scaled([...parts.flatMap(part => part.points), ...ring], view, width, room);
      // Arrows that point outwards get room of their own.
      for (let round = 0; round < 3; ++round) {
        const tips = known.map(anchor => { const [x, y] = map.at(anchor.at), [u, v] = vector(anchor); return [x + u, y + v]; });
        room.left += Math.max(0, 8 - Math.min(...tips.map(tip => tip[0])));
        room.right += Math.max(0, Math.max(...tips.map(tip => tip[0])) - width + 8);
        room.top += Math.max(0, 8 - Math.min(...tips.map(tip => tip[1])));
        room.bottom += Math.max(0, Math.max(...tips.map(tip => tip[1])) - map.height + 8 + line);
        map = scaled([...parts.flatMap(part => part.points), ...ring], view, width, room);
      }
      const pale = svg.make(picture, "g", { opacity: 0.35 });
      drawParts(pale, parts, map.at);
      const tail = known.map(anchor => [...map.at(anchor.at), ...vector(anchor)]);
      known.forEach((anchor, i) => {
        const [x, y, u, v] = tail[i];
        svg.make(picture, "circle", { cx: x, cy: y, r: 3, fill: "#fff" });
        svg.arrow(picture, x, y, x + u, y + v, { stroke: ink.force, class: "force" });
      });
      tail.forEach(([x, y, u, v]) => {
        for (let at = 0; at <= 1; at += 0.1) text.keepOff(x + at * u - 4, y + at * v - 4, x + at * u + 4, y + at * v + 4);
      });
      known.forEach((anchor, i) => {
        const [x, y, u, v] = tail[i], still = Math.hypot(u, v) < 0.5;
        text.beside(anchor.sign, x, y, still ? 0 : -u, still ? 1 : -v);
      });
      if (largest > 0) {
        const force = Number(largest.toPrecision(1)), length = longest * force / largest, y = map.height - 10;
        svg.arrow(picture, 12, y, 12 + length, y, { stroke: ink.force });
        text.at(sizes.of("N", force), 20 + length + svg.widthOf(sizes.of("N", force)) / 2, y);
      }
      return map.height;
    });
    return true;
  };
  return { views, forces };
})();
