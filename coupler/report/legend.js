/** What is written over a picture, in letters of so many pixels: texts, the scale of its colours, the axes. */
const makeLegend = canvas => {
  const pen = canvas.getContext("2d");
  const write = (text, x, y, size, align = "left", colour = "#1d2530") => {
    pen.font = `${size}px system-ui, sans-serif`;
    pen.textAlign = align;
    pen.lineJoin = "round";
    pen.lineWidth = size / 4;
    pen.strokeStyle = "#ffffffcc";
    pen.strokeText(text, x, y);
    pen.fillStyle = colour;
    pen.fillText(text, x, y);
  };
  /** The colour that the shaders give a value from -1 to 1. */
  const rampColour = value => {
    const ramp = makeRenderer.ramp, place = Math.min(1, Math.max(0, 0.5 + 0.5 * value)) * (ramp.length - 1), i = Math.min(Math.floor(place), ramp.length - 2);
    const parts = [1, 3, 5].map(k => { const [a, b] = [i, i + 1].map(n => parseInt(ramp[n].slice(k, k + 2), 16)); return Math.round(a + (b - a) * (place - i)); });
    return `rgb(${parts})`;
  };
  const drawLegend = (name, { low, high, unit, base = 0 }, letters) => {
    const shown = unit ? units.suited(unit, Math.max(-low, high)) : { unit: "%", factor: 100 };
    const full = Math.max(-low, high - base), width = Math.min(18 * letters, 0.6 * canvas.width), x = letters, y = canvas.height - 2.2 * letters;
    for (let i = 0; i < width; ++i) {
      pen.fillStyle = rampColour((low - base + (high - low) * i / width) / full);
      pen.fillRect(x + i, y, 1.5, 0.7 * letters);
    }
    write(`${name} (${shown.unit})`, x, y - 0.5 * letters, letters);
    const marks = low < -0.15 * high && high > -0.15 * low ? [low, 0, high] : [low, (low + high) / 2, high];
    marks.forEach((value, i) => write(number(value * shown.factor, 3), x + width * (value - low) / (high - low), y + 1.8 * letters, 0.9 * letters, ["left", "center", "right"][i]));
  };
  /** The axes' directions, as they lie in the picture, at the lower right. */
  const drawAxes = (eye, letters) => {
    const x = canvas.width - 4 * letters, y = canvas.height - 4 * letters, length = 2.4 * letters;
    ["x", "y", "z"].forEach((name, k) => {
      const across = eye.right[k], up = eye.up[k], seen = Math.hypot(across, up), colour = ["#b3261e", "#1b7a3d", "#1f6fb2"][k];
      if (seen < 0.05) return;
      pen.strokeStyle = colour;
      pen.lineWidth = letters / 8;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + length * across, y - length * up);
      pen.stroke();
      write(name, x + length * across + 0.7 * letters * across / seen, y - length * up - 0.7 * letters * up / seen + 0.35 * letters, letters, "center", colour);
    });
  };
  return { write, drawLegend, drawAxes };
};
