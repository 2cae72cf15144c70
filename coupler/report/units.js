/** Names of probes, units that suit the size of values, and curves sorted into charts that can be read. */
const units = (() => {
  /** From this size on a value is shown in the unit: the first that it reaches counts, the last one for all smaller values. */
  const ladders = {
    N: [[1e7, "MN", 1e-6], [1e3, "kN", 1e-3], [0, "N", 1]],
    J: [[1e7, "MJ", 1e-6], [1e3, "kJ", 1e-3], [0, "J", 1]],
    Pa: [[1e9, "GPa", 1e-9], [1e6, "MPa", 1e-6], [1e3, "kPa", 1e-3], [0, "Pa", 1]],
    m: [[0.1, "m", 1], [0, "mm", 1e3]],
    "m/s": [[0.1, "m/s", 1], [0, "mm/s", 1e3]],
    s: [[0.1, "s", 1], [1e-4, "ms", 1e3], [0, "us", 1e6]],
  };
  const suited = (unit, size) => {
    const [, shown, factor] = ladders[unit]?.find(([from]) => size >= from) ?? [0, unit, 1];
    return size > 0 ? { unit: shown, factor } : { unit, factor: 1 };
  };
  const sizeOf = values => values.reduce((size, value) => Math.max(size, Math.abs(value)), 0);

  const spelled = { m_per_s: "m/s", rad_per_s: "rad/s", m2: "m²", 1: "" };
  /** "net_centre.displacement_z_m" as probe, quantity, direction and unit. */
  const parsed = name => {
    const match = name.match(/^(.*)\.(.+?)(?:_([xyz]))?_(m_per_s|rad_per_s|rad|N|m2|m|J|Pa|kg|s|1)$/);
    return match ? { probe: match[1], quantity: match[2], direction: match[3] ?? "", unit: spelled[match[4]] ?? match[4] }
                 : { probe: name.split(".")[0], quantity: name.split(".").slice(1).join(".") || name, direction: "", unit: "" };
  };

  /** "retaining_2w" and "post_3" belong to the families "retaining" and "post"; "net_centre" stands for itself. */
  const stem = name => name.replace(/_([a-z]{1,2}|[a-z]{0,2}\d+[a-z]{0,2})(?=\.|$)/i, "");
  /** A map from families to their members, in the order of the names. One that would be alone keeps its own name. */
  const families = names => {
    const found = new Map();
    names.forEach(name => found.set(stem(name), [...(found.get(stem(name)) ?? []), name]));
    return new Map([...found].map(([family, members]) => [members.length > 1 ? family : members[0], members]));
  };

  const most = 8;  // curves in a chart; there are as many colours
  const split = (curves, key) => {
    const parts = new Map();
    curves.forEach(curve => parts.set(key(curve), [...(parts.get(key(curve)) ?? []), curve]));
    return parts;
  };
  /** Lists of at most `most` curves of one quantity: by family, then by direction, then by number. */
  const charted = curves => {
    if (curves.length <= most) return [{ about: "", curves }];
    const byFamily = families([...new Set(curves.map(curve => curve.probe))]);
    const family = new Map([...byFamily].flatMap(([name, members]) => members.map(member => [member, name])));
    const charts = [];
    let rest = { names: [], curves: [] };
    const closeRest = () => {
      if (rest.curves.length) charts.push({ about: rest.names.join(", "), curves: rest.curves });
      rest = { names: [], curves: [] };
    };
    const chunks = (about, list) => {
      for (let i = 0; i < list.length; i += most) charts.push({ about: list.length > most ? `${about}, from ${list[i].probe} on` : about, curves: list.slice(i, i + most) });
    };
    split(curves, curve => family.get(curve.probe)).forEach((members, name) => {
      if (members.length > most) split(members, curve => curve.direction).forEach((list, direction) => chunks((name + " " + direction).trim(), list));
      else if (members.length > most / 2) charts.push({ about: name, curves: members });
      else {
        if (rest.curves.length + members.length > most) closeRest();
        rest.names.push(name);
        rest.curves.push(...members);
      }
    });
    closeRest();
    return charts;
  };
  return { suited, sizeOf, parsed, families, charted };
})();
