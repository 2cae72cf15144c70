/** Mouse, fingers and keys on a picture, as moves of an eye: turn, shift and zoom, reset, toggle. */
const listenToGestures = (canvas, moves, changed) => {
  const pointers = new Map();
  const spread = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  canvas.addEventListener("pointerdown", event => {
    if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", event => {
    const known = pointers.get(event.pointerId);
    if (!known) return;
    const x = event.clientX - known.x, y = event.clientY - known.y, before = pointers.size === 2 ? spread() : 0;
    known.x = event.clientX;
    known.y = event.clientY;
    if (pointers.size === 2) {
      if (before > 0) moves.zoom(spread() / before);
      moves.shift(x / 2, y / 2);
    } else if (event.shiftKey || event.buttons & 2 || event.buttons & 4) moves.shift(x, y);
    else moves.turn(x, y);
    changed();
  });
  ["pointerup", "pointercancel"].forEach(name => canvas.addEventListener(name, event => pointers.delete(event.pointerId)));
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  // The wheel scrolls the page until the picture was clicked.
  canvas.addEventListener("wheel", event => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    moves.zoom(Math.exp(-0.0015 * event.deltaY));
    changed();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { moves.reset(); changed(); });
  const keys = { ArrowLeft: () => moves.turn(-15, 0), ArrowRight: () => moves.turn(15, 0), ArrowUp: () => moves.turn(0, -15), ArrowDown: () => moves.turn(0, 15),
    "+": () => moves.zoom(1.2), "-": () => moves.zoom(1 / 1.2), " ": moves.toggle };
  canvas.addEventListener("keydown", event => {
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
    changed();
  });
};
