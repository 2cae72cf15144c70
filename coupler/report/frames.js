/** The numbers of a replay, unpacked: where every node is at every frame, and which way is up. */
const unpackFrames = (replay, facts = {}) => {
  const bytes = text => {
    const letters = atob(text), made = new Uint8Array(letters.length);
    for (let i = 0; i < made.length; ++i) made[i] = letters.charCodeAt(i);
    return made;
  };
  const unpackGroup = group => {
    const Cells = group.wide ? Uint32Array : Uint16Array;
    const values = group.values ? bytes(group.values) : null;
    const cells = new Cells(bytes(group.cells).buffer), steps = new Uint16Array(bytes(group.positions).buffer);
    const cellCount = cells.length / group.kind, length = 3 * group.nodes;
    return {
      ...group, cells, cellCount,
      radii: group.radii ? new Float32Array(bytes(group.radii).buffer) : null,
      /** Positions in steps of the group's box. */
      steps: frame => group.moves ? steps.subarray(frame * length, (frame + 1) * length) : steps,
      values: values && (frame => values.subarray(frame * cellCount, (frame + 1) * cellCount)),
    };
  };

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const combined = (...terms) => [0, 1, 2].map(k => terms.reduce((sum, [factor, vector]) => sum + factor * vector[k], 0));
  const unit = vector => { const size = Math.hypot(...vector); return vector.map(value => value / size); };
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const vectorOf = (name, suffix) => ["x", "y", "z"].map(axis => facts[`${name}_${axis}_${suffix}`] ?? 0);

  /** Against gravity; z where the result names none. */
  const upward = () => {
    for (const side of ["structure", "particles"]) {
      const gravity = vectorOf(side + ".gravity", "m_per_s2");
      if (Math.hypot(...gravity) > 0) return unit(gravity.map(value => -value));
    }
    return axes[2];
  };
  const up = upward();
  const level = axes.reduce((best, axis) => Math.abs(dot(axis, up)) < Math.abs(dot(best, up)) - 1e-6 ? axis : best);
  const across = unit(combined([1, level], [-dot(level, up), up]));
  const deep = cross(up, across);
  /** The picture's directions for an eye at an azimuth and a height (rad): to the right, upwards, towards the eye. */
  const directions = (azimuth, height) => {
    const right = combined([Math.cos(azimuth), across], [Math.sin(azimuth), deep]);
    const toward = combined([-Math.cos(height) * Math.cos(azimuth), deep], [Math.cos(height) * Math.sin(azimuth), across], [Math.sin(height), up]);
    return { right, up: cross(toward, right), toward };
  };

  const boxOf = group => {
    const room = group.radii ? group.radii.reduce((most, radius) => Math.max(most, radius), 0) : 0;
    return { low: group.low.map(value => value - room), high: group.low.map((value, k) => value + 65535 * group.step[k] + room) };
  };
  const joined = boxes => boxes.reduce((sum, box) => ({ low: sum.low.map((value, k) => Math.min(value, box.low[k])), high: sum.high.map((value, k) => Math.max(value, box.high[k])) }));
  const clipped = (box, within) => {
    const room = 0.5 * Math.hypot(...within.high.map((value, k) => value - within.low[k]));
    return { low: box.low.map((value, k) => Math.min(within.high[k], Math.max(value, within.low[k] - room))),
             high: box.high.map((value, k) => Math.max(within.low[k], Math.min(value, within.high[k] + room))) };
  };
  /** What a picture shows: the structure, and of what flies about no more than lies near it. */
  const boxToShow = groups => {
    const fixed = groups.filter(group => group.structure);
    if (!fixed.length) return joined(groups.map(boxOf));
    const frame = joined(fixed.map(boxOf));
    return joined([frame, ...groups.filter(group => !group.structure).map(group => clipped(boxOf(group), frame))]);
  };

  /** A plane of the scene as a grid of squares about the middle of the picture, since it has no end. */
  const planeGroups = box => {
    const names = [...new Set(Object.keys(facts).map(name => name.match(/^particles\.planes\.(.*)\.normal_x_1$/)?.[1]).filter(Boolean))];
    const middle = box.low.map((value, k) => (value + box.high[k]) / 2), size = Math.hypot(...box.high.map((value, k) => value - box.low[k])) / 2;
    return names.map(name => {
      const normal = vectorOf(`particles.planes.${name}.normal`, "1"), point = vectorOf(`particles.planes.${name}.point`, "m");
      const foot = combined([1, middle], [-dot(combined([1, middle], [-1, point]), normal), normal]);
      const rough = axes.reduce((best, axis) => Math.abs(dot(axis, normal)) < Math.abs(dot(best, normal)) ? axis : best);
      const first = unit(combined([1, rough], [-dot(rough, normal), normal])), second = cross(normal, first);
      return gridGroup(name, foot, first, second, size);
    });
  };
  const gridGroup = (name, foot, first, second, size) => {
    const count = 11, places = [], cells = [];
    for (let i = 0; i < count; ++i)
      for (let j = 0; j < count; ++j) {
        places.push(combined([1, foot], [size * (2 * i / (count - 1) - 1), first], [size * (2 * j / (count - 1) - 1), second]));
        if (i + 1 < count) cells.push(i * count + j, (i + 1) * count + j);
        if (j + 1 < count) cells.push(i * count + j, i * count + j + 1);
      }
    const low = [0, 1, 2].map(k => Math.min(...places.map(place => place[k]))), high = [0, 1, 2].map(k => Math.max(...places.map(place => place[k])));
    const step = low.map((value, k) => (high[k] - value) / 65535);
    const steps = Uint16Array.from(places.flatMap(place => place.map((value, k) => step[k] > 0 ? Math.round((value - low[k]) / step[k]) : 0)));
    return { name: "plane " + name, kind: 2, structure: false, plane: true, stride: 1, nodes: places.length, low, step, moves: false, radii: null, values: null,
      cells: Uint16Array.from(cells), cellCount: cells.length / 2, steps: () => steps };
  };

  const groups = replay.groups.map(unpackGroup).filter(group => group.nodes > 0);
  const box = groups.length ? boxToShow(groups) : null;
  if (box) groups.push(...planeGroups(box));
  const families = units.families(groups.map(group => group.name));
  const familyOf = new Map([...families].flatMap(([family, members]) => members.map(member => [member, family])));
  const roleOf = group => group.name === "rocks" || (group.kind === 1 && group.radii) ? "rock" : group.structure ? "structure" : "surroundings";
  const structureFamilies = [...new Set(groups.filter(group => roleOf(group) === "structure").map(group => familyOf.get(group.name)))];
  const partColour = group => ({ rock: "#8d7b68", surroundings: "#8b95a1" })[roleOf(group)] ?? colours[structureFamilies.indexOf(familyOf.get(group.name)) % colours.length];
  /** m; of any node of the structure from where it was in the first frame, over all frames. */
  const largestWay = () => {
    let most = 0;
    groups.filter(group => group.structure && group.moves).forEach(group => {
      const start = group.steps(0);
      replay.times.forEach((time, frame) => {
        const now = group.steps(frame);
        for (let i = 0; i < now.length; i += 3)
          most = Math.max(most, Math.hypot(group.step[0] * (now[i] - start[i]), group.step[1] * (now[i + 1] - start[i + 1]), group.step[2] * (now[i + 2] - start[i + 2])));
      });
    });
    return most;
  };
  return { ...replay, groups, box, whole: groups.length ? joined(groups.map(boxOf)) : null, directions, dot, largestWay, families, familyOf, roleOf, partColour };
};
