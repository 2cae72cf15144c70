/** Values as the trade writes them: kN, kJ, m or mm, degrees, percent; what is not known says so. */
const sizes = (() => {
  const unknown = "not measured";
  const known = value => value !== null && value !== undefined && value !== "";
  /** As many digits as are asked for, but none far below those of the largest value beside it. */
  const beside = (largest, digits) => {
    const finest = largest > 0 ? 10 ** (Math.floor(Math.log10(largest)) - digits - 1) : 0;
    return value => number(finest && Math.abs(value) < finest / 2 ? 0 : Math.abs(value) < 1000 * finest ? Number((Math.round(value / finest) * finest).toPrecision(digits)) : value, digits);
  };
  /** One unit for all values of a column: its name and how to write one of them. */
  const column = (unit, values, digits = 3) => {
    const largest = units.sizeOf(values.filter(value => typeof value === "number")), shown = units.suited(unit, largest), write = beside(shown.factor * largest, digits);
    return { unit: shown.unit, text: (value, lacking = unknown) => known(value) ? write(shown.factor * value) : lacking };
  };
  /** A value with its unit. */
  const of = (unit, value, digits = 3) => {
    if (!known(value)) return unknown;
    if (typeof value !== "number") return [value, unit].filter(known).join(" ");
    if (unit === "1") unit = "";
    const { unit: name, text } = column(unit, [value], digits);
    return name ? `${text(value)} ${name}` : text(value);
  };
  const percent = (share, lacking = unknown) => known(share) ? `${beside(100, 3)(100 * share)} %` : lacking;
  const degrees = (angle, lacking = unknown) => known(angle) ? `${number(angle, 3)}°` : lacking;
  return { unknown, known, column, of, percent, degrees };
})();
