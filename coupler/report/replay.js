/** The moving picture of a result with what turns, moves and colours it. */
const showReplay = (page, fields, renderer, summary) => {
  const times = fields.times, last = times.length - 1;
  const corner = { centre: fields.box.low.map((value, k) => (value + fields.box.high[k]) / 2) };
  const radius = Math.hypot(...fields.whole.high.map((value, k) => Math.max(Math.abs(value - corner.centre[k]), Math.abs(fields.whole.low[k] - corner.centre[k])))) || 1;
  const state = { time: times[fields.peak ?? 0], playing: false, slowness: 1, colour: "part", hidden: new Set(), touched: false, eye: null };

  const { roleOf, families, familyOf, partColour } = fields;

  // ---- colours ----
  const limits = { tension: name => summary.tables?.utilisation?.[name]?.breaking_load_N, compression: name => summary.tables?.buckling?.[name]?.buckling_load_N };
  const colourings = new Map([["part", null]]);
  fields.colours.forEach((scale, index) => {
    const low = scale.low, high = scale.low + 254 * scale.step;
    // A prestressed net never gets near zero: its colours begin at its least force.
    colourings.set(scale.name, { of: group => group.colour === index, low, high, base: Math.max(0, low), unit: scale.unit, scale, factors: () => [1, 1] });
    const limited = fields.groups.filter(group => group.colour === index && scale.unit === "N" && (limits.tension(group.name) || limits.compression(group.name)));
    if (!limited.length) return;
    const factors = group => [limits.tension(group.name) ? 1 / limits.tension(group.name) : 0, limits.compression(group.name) ? 1 / limits.compression(group.name) : 0];
    let least = 0, most = 0;
    limited.forEach(group => {
      const [tension, compression] = factors(group);
      times.forEach((time, frame) => group.values(frame).forEach(number => {
        const value = scale.low + scale.step * number;
        if (number < 255) { most = Math.max(most, value * tension); least = Math.min(least, value * compression); }
      }));
    });
    if (most > least) colourings.set("utilisation", { of: group => limited.includes(group), low: least, high: most, unit: "", scale, factors });
  });
  const way = fields.largestWay();
  if (way > 0) colourings.set("displacement", { of: group => group.structure, low: 0, high: way, unit: "m", reach: way });
  const quiet = "#b9c0c8";
  const widthOf = group => group.plane ? 0.6 : group.structure ? (group.cellCount > 300 ? 1.2 : 3) : 0.8;
  /** The rock is to be seen through a sheet, and through wires that lie as close as in one. */
  const clearness = group => roleOf(group) === "rock" ? 1 : group.kind === 3 ? 0.45 : group.cellCount > 3000 ? 0.3 : 1;
  /** How a group is drawn now; nothing where it is hidden. */
  const styleOf = sharpness => group => {
    if (state.hidden.has(familyOf.get(group.name))) return null;
    const chosen = colourings.get(state.colour), alpha = clearness(group);
    const width = widthOf(group) * sharpness, plain = { colour: chosen && roleOf(group) === "structure" ? quiet : partColour(group), alpha, width, colouring: 0 };
    if (!chosen || !chosen.of(group)) return plain;
    if (chosen.reach) return { ...plain, alpha: Math.max(alpha, 0.75), colouring: 2, reach: chosen.reach };
    const base = chosen.base ?? 0, full = Math.max(-chosen.low, chosen.high - base);
    return { ...plain, alpha: Math.max(alpha, 0.75), colouring: 1, scale: [chosen.scale.low - base, chosen.scale.step], factors: chosen.factors(group).map(factor => factor / full) };
  };

  // ---- the eye ----
  const views = { "turned": [-0.6, 0.4], "front": [0, 0], "side": [Math.PI / 2, 0], "top": [0, Math.PI / 2] };
  const lookFrom = name => { state.eye = { azimuth: views[name][0], height: views[name][1], zoom: 1, shift: [0, 0] }; };
  lookFrom("turned");
  /** Half of the box's extent along a direction of the picture. */
  const reachAlong = direction => fields.box.low.reduce((sum, low, k) => sum + Math.abs(direction[k]) * (fields.box.high[k] - low) / 2, 0) || 1;
  const eyeOn = canvas => {
    const { azimuth, height, zoom, shift } = state.eye, seen = fields.directions(azimuth, height);
    const scale = 0.88 * zoom * Math.min(canvas.width / (2 * reachAlong(seen.right)), canvas.height / (2 * reachAlong(seen.up)));
    return { ...seen, centre: corner.centre, depth: 1.05 * radius, scale, shift: [shift[0] * canvas.width, shift[1] * canvas.width] };
  };

  // ---- time ----
  /** The frame before a time, and how far it is to the one after. */
  const placeOf = time => {
    let before = 0;
    while (before < last - 1 && times[before + 1] <= time) ++before;
    const span = times[before + 1] - times[before];
    return { frames: [before, before + 1], between: span > 0 ? Math.min(1, Math.max(0, (time - times[before]) / span)) : 0 };
  };
  const timeUnit = units.suited("s", times[last]);
  const inTime = time => `${number(time * timeUnit.factor, 4)} ${timeUnit.unit}`;
  const noteOf = time => {
    const notes = [[fields.contact, "first contact"], [fields.peak, "largest displacement"], [last, "last frame"]];
    return notes.filter(([frame]) => frame !== null && Math.abs(times[frame] - time) < 1e-9 * times[last]).map(([, note]) => note).join(", ");
  };

  // ---- the picture ----
  page.appendChild(element("h2", "Replay"));
  const frame = page.appendChild(element("div", "", { class: "replay" }));
  const canvas = frame.appendChild(element("canvas", "", { tabindex: "0", role: "img", "aria-label": "The replay: drag to turn, with two fingers or the right button to shift and zoom" }));
  const { write, drawLegend, drawAxes } = makeLegend(canvas);
  const sharpness = () => Math.min(2, Math.max(1, window.devicePixelRatio || 1));
  const fit = () => {
    const width = Math.round(frame.clientWidth * sharpness());
    if (!width || canvas.width === width) return;
    canvas.width = width;
    canvas.height = Math.round(width * (frame.clientWidth < 600 ? 0.85 : 0.56));
  };
  const draw = () => {
    fit();
    const eye = eyeOn(canvas), letters = Math.round(13 * sharpness() * (frame.clientWidth < 600 ? 0.95 : 1.1));
    renderer.draw(canvas, { ...placeOf(state.time), eye, style: styleOf(sharpness()) });
    const note = noteOf(state.time);
    write(`t = ${inTime(state.time)}`, letters, 2 * letters, 1.3 * letters);
    if (note) write(note, letters, 3.5 * letters, letters);
    const chosen = colourings.get(state.colour);
    if (chosen) drawLegend(state.colour, chosen, letters);
    drawAxes(eye, letters);
  };
  let waiting = false;
  const drawSoon = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; draw(); });
  };

  // ---- what is below the picture ----
  const bar = frame.appendChild(element("nav"));
  const play = bar.appendChild(element("button", "▶ Play", { class: "on", style: "min-width: 6.5em" }));
  const slider = bar.appendChild(element("input", "", { type: "range", min: times[0], max: times[last], step: (times[last] - times[0]) / 2000, "aria-label": "time" }));
  const choice = (parent, text, entries, chosen, act) => {
    const label = parent.appendChild(element("label", text + " "));
    const select = label.appendChild(element("select"));
    entries.forEach(([value, name]) => select.appendChild(element("option", name, { value })));
    select.value = chosen;
    select.addEventListener("change", () => { act(select.value); drawSoon(); });
    return select;
  };
  const show = time => {
    state.time = Math.min(times[last], Math.max(times[0], time));
    slider.value = state.time;
    drawSoon();
  };
  const slownesses = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  // A run is to take some six seconds.
  state.slowness = slownesses.find(slowness => slowness * (times[last] - times[0]) >= 6) ?? 1000;
  choice(bar, "speed", slownesses.map(slowness => [slowness, slowness === 1 ? "real time" : "1/" + slowness]), state.slowness, value => { state.slowness = Number(value); });

  let tick = null;
  const pause = () => { state.playing = false; play.textContent = "▶ Play"; tick = null; };
  const step = now => {
    if (!state.playing) return;
    if (tick !== null) state.time += (now - tick) / 1000 / state.slowness;
    tick = now;
    if (state.time >= times[last]) pause();
    show(state.time);
    requestAnimationFrame(step);
  };
  const start = () => {
    if (!state.touched || state.time >= times[last]) state.time = times[0];
    state.touched = state.playing = true;
    play.textContent = "❚❚ Pause";
    requestAnimationFrame(step);
  };
  const toggle = () => state.playing ? pause() : start();
  play.addEventListener("click", toggle);
  slider.addEventListener("input", () => { pause(); state.touched = true; show(Number(slider.value)); });

  const more = frame.appendChild(element("nav"));
  const button = (parent, text, act) => {
    const made = parent.appendChild(element("button", text));
    made.addEventListener("click", () => { act(made); drawSoon(); });
    return made;
  };
  [["first contact", fields.contact], ["largest displacement", fields.peak], ["end", last]].filter(([, place]) => place !== null)
    .forEach(([name, place]) => button(more, name, () => { pause(); state.touched = true; show(times[place]); }));
  const spot = more.appendChild(element("span", "view"));
  spot.className = "quiet";
  ["front", "side", "top"].forEach(name => button(more, name, () => lookFrom(name)));
  button(more, "reset", () => lookFrom("turned"));
  const colourChoice = choice(more, "colour by", [...colourings.keys()].map(name => [name, name]), state.colour, value => { state.colour = value; });

  const parts = frame.appendChild(element("nav", "", { class: "parts" }));
  families.forEach((members, family) => {
    const made = button(parts, members.length > 1 ? `${family} (${members.length})` : family, () => {
      state.hidden.has(family) ? state.hidden.delete(family) : state.hidden.add(family);
      made.classList.toggle("off", state.hidden.has(family));
    });
    made.style.borderLeft = `.7em solid ${partColour(fields.groups.find(group => group.name === members[0]))}`;
  });

  // ---- mouse, fingers, keys ----
  const eyeMoves = {
    turn(x, y) {
      state.eye.azimuth -= 0.008 * x;
      state.eye.height = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, state.eye.height + 0.008 * y));
    },
    shift(x, y) { state.eye.shift = [state.eye.shift[0] + x / frame.clientWidth, state.eye.shift[1] + y / frame.clientWidth]; },
    /** What lies under the middle of the picture stays there. */
    zoom(factor) {
      const zoom = Math.min(200, Math.max(0.2, state.eye.zoom * factor)), ratio = zoom / state.eye.zoom;
      state.eye.zoom = zoom;
      state.eye.shift = state.eye.shift.map(value => value * ratio);
    },
    reset() { lookFrom("turned"); },
    toggle,
  };
  listenToGestures(canvas, eyeMoves, drawSoon);

  // ---- what the picture leaves out ----
  const said = [];
  const shownFrames = times.length === fields.of ? `all ${fields.of} frames of the result` : `${times.length} of the ${fields.of} frames of the result, evenly spaced, with the first, the last and those named above among them`;
  said.push(`It shows ${shownFrames}; between them everything moves along straight lines.`);
  const thinned = fields.groups.filter(group => group.stride > 1).map(group => `one of ${group.stride} cells of ${group.name}`);
  if (thinned.length) said.push(`Drawn: ${thinned.join(", ")}; all cells would make the page too large.`);
  const doubles = Object.entries(fields.doubles).map(([name, below]) => `${name} lies on ${below}`);
  if (doubles.length) said.push(doubles.join(", ") + ", to a thousandth of its size: drawn once.");
  if (fields.groups.some(group => group.breaks)) said.push("Broken cells vanish.");
  if (fields.groups.some(group => group.plane)) said.push("A plane has no end: a piece of it is drawn.");
  if (limits && colourings.has("utilisation")) said.push("Utilisation is tension over the breaking load, and compression (negative) over the buckling load.");
  if (way > 0) said.push("Displacement is counted from the first frame.");
  const finest = Math.max(...fields.groups.map(group => Math.max(...group.step))) / 2;
  said.push(`Positions are rounded to ${number(finest * 1e3, 2)} mm or finer.`);
  frame.appendChild(element("p", "Drag to turn; shift, right button or two fingers to move; wheel (after a click) or two fingers to zoom; double click to reset.", { class: "quiet hint" }));
  frame.appendChild(element("p", said.join(" "), { class: "quiet" }));

  /** "#frame=12&view=top&colour=axial force" in the page's address. */
  const obey = () => {
    const wanted = new URLSearchParams(location.hash.slice(1));
    if (views[wanted.get("view")]) lookFrom(wanted.get("view"));
    if (colourings.has(wanted.get("colour"))) state.colour = colourChoice.value = wanted.get("colour");
    const place = Number(wanted.get("frame") ?? NaN);
    if (place >= 0 && place <= last) { pause(); state.touched = true; state.time = times[Math.round(place)]; }
    show(state.time);
  };
  window.addEventListener("hashchange", obey);
  new ResizeObserver(() => { if (canvas.width !== Math.round(frame.clientWidth * sharpness())) drawSoon(); }).observe(frame);
  obey();
  draw();
};
