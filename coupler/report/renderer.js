/**
 * Draws frames of a replay with WebGL2 onto any two-dimensional canvas; null where the browser has no WebGL2.
 * Positions stay whole numbers until the vertex shader, where a node is a texel: one texture holds the frame before, one the frame after.
 */
const makeRenderer = (() => {
  const row = 1024;  // texels; a node's place in its texture

  /** Compression, nothing, tension: evenly spaced from -1 to 1. */
  const ramp = ["#0b2a6f", "#2b62b8", "#5f97d6", "#93b7dc", "#aab2bb", "#e3b53c", "#e87d24", "#cf3328", "#6a0d3a"];
  const rgb = colour => [1, 3, 5].map(k => parseInt(colour.slice(k, k + 2), 16) / 255);

  const common = `#version 300 es
    precision highp float; precision highp int; precision highp usampler2D;
    uniform usampler2D before, after, start;
    uniform float between;          // from the frame before to the frame after
    uniform vec3 origin, steps;     // of the group's box, m
    uniform mat3 turn;              // to right, up, toward
    uniform vec3 zoom;              // from m to the picture
    uniform vec2 shift, pixels;
    uniform vec4 colour;            // of the part
    uniform int colouring;          // 0 by part, 1 by value, 2 by way
    uniform vec2 scale, factors;    // value = scale.x + scale.y * number; factors of tension and compression
    uniform float reach, fading;
    uniform bool breaks;
    uniform vec3 ramp[${ramp.length}];
    in vec2 value;
    out vec4 shade;
    vec3 steps_of(usampler2D frame, uint node) { return vec3(texelFetch(frame, ivec2(int(node) % ${row}, int(node) / ${row}), 0).xyz); }
    vec3 place(uint node) { return turn * (origin + steps * mix(steps_of(before, node), steps_of(after, node), between)); }
    float way(uint node) { return length(steps * (mix(steps_of(before, node), steps_of(after, node), between) - steps_of(start, node))); }
    vec4 on_picture(vec3 view) { return vec4(view.xy * zoom.xy + shift, view.z * zoom.z, 1.0); }
    vec3 on_ramp(float at) {
      float place = clamp(0.5 + 0.5 * at, 0.0, 1.0) * ${(ramp.length - 1).toFixed(1)};
      int i = min(int(place), ${ramp.length - 2});
      return mix(ramp[i], ramp[i + 1], place - float(i));
    }
    vec4 shaded(uint node, float depth) {
      vec3 own = colour.rgb;
      if (colouring == 1) {
        float number = scale.x + scale.y * mix(value.x, breaks && value.y > 254.5 ? value.x : value.y, between);
        own = on_ramp(number * (number > 0.0 ? factors.x : factors.y));
      } else if (colouring == 2) own = on_ramp(way(node) / reach);
      return vec4(mix(own, vec3(1.0), fading * clamp(0.5 + 0.5 * depth * zoom.z, 0.0, 1.0)), colour.a);
    }
    bool gone() { return breaks && value.x > 254.5; }
    const vec4 nowhere = vec4(2.0, 2.0, 2.0, 1.0);`;
  const flat_fragment = `#version 300 es
    precision highp float;
    in vec4 shade; out vec4 drawn;
    void main() { drawn = shade; }`;
  const shaders = {
    1: [`${common}
      in uint node; in float radius;
      uniform float smallest;       // m
      out vec2 at; out float depth;
      void main() {
        vec3 view = place(node);
        float size = max(radius, smallest);
        at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
        shade = shaded(node, view.z);
        depth = size * zoom.z;
        gl_Position = on_picture(view + vec3(at * size, 0.0));
      }`, `#version 300 es
      precision highp float;
      in vec4 shade; in vec2 at; in float depth; out vec4 drawn;
      void main() {
        float out_there = dot(at, at);
        if (out_there > 1.0) discard;
        float bulge = sqrt(1.0 - out_there);
        drawn = vec4(shade.rgb * (0.45 + 0.55 * bulge), 1.0);
        gl_FragDepth = gl_FragCoord.z + 0.5 * depth * bulge;
      }`],
    2: [`${common}
      in uvec2 ends;
      uniform float width;          // pixels
      void main() {
        vec3 a = place(ends.x), b = place(ends.y), own = gl_VertexID < 2 ? a : b;
        vec2 along = b.xy - a.xy;
        along = length(along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
        shade = shaded(gl_VertexID < 2 ? ends.x : ends.y, own.z);
        gl_Position = on_picture(own) + vec4(vec2(-along.y, along.x) * (gl_VertexID % 2 == 0 ? width : -width) / pixels, 0.0, 0.0);
        if (gone()) gl_Position = nowhere;
      }`, flat_fragment],
    3: [`${common}
      in uvec3 corners;
      void main() {
        vec3 a = place(corners.x), b = place(corners.y), c = place(corners.z);
        vec3 own = gl_VertexID == 0 ? a : gl_VertexID == 1 ? b : c;
        vec3 normal = cross(b - a, c - a);
        float light = length(normal) > 0.0 ? abs(dot(normalize(normal), normalize(vec3(-0.3, 0.5, 0.8)))) : 1.0;
        shade = shaded(gl_VertexID == 0 ? corners.x : gl_VertexID == 1 ? corners.y : corners.z, own.z);
        shade.rgb *= 0.55 + 0.45 * light;
        gl_Position = on_picture(own);
        if (gone()) gl_Position = nowhere;
      }`, flat_fragment],
  };

  const compiled = (gl, [vertex, fragment]) => {
    const program = gl.createProgram();
    [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]].forEach(([kind, source]) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    });
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error("the replay's shaders: " + gl.getProgramInfoLog(program) + gl.getAttachedShaders(program).map(shader => gl.getShaderInfoLog(shader)).join(""));
    const places = {};
    return { program, at: name => places[name] ??= gl.getUniformLocation(program, name), attribute: name => gl.getAttribLocation(program, name) };
  };

  /** A group's textures and buffers, and which frames are in them. */
  const uploaded = (gl, group, shader) => {
    const height = Math.ceil(group.nodes / row), texels = new Uint16Array(3 * row * height);
    const texture = () => {
      const made = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, made);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGB16UI, row, height);
      [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER].forEach(name => gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST));
      return { made, frame: -1 };
    };
    const show = (kept, frame) => {
      if (kept.frame === frame) return;
      texels.set(group.steps(frame));
      gl.bindTexture(gl.TEXTURE_2D, kept.made);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, row, height, gl.RGB_INTEGER, gl.UNSIGNED_SHORT, texels);
      kept.frame = frame;
    };
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const attribute = (name, data, size, type, whole) => {
      const place = shader.attribute(name), buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
      if (place < 0) return buffer;
      gl.enableVertexAttribArray(place);
      gl.vertexAttribDivisor(place, 1);
      whole ? gl.vertexAttribIPointer(place, size, type, 0, 0) : gl.vertexAttribPointer(place, size, type, false, 0, 0);
      return buffer;
    };
    attribute({ 1: "node", 2: "ends", 3: "corners" }[group.kind], group.cells, group.kind, group.wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT, true);
    if (group.kind === 1) attribute("radius", group.radii ?? new Float32Array(group.cellCount), 1, gl.FLOAT, false);
    const pairs = group.values ? new Uint8Array(2 * group.cellCount) : null;
    const values = pairs && attribute("value", pairs, 2, gl.UNSIGNED_BYTE, false);
    let shown = "";
    const showValues = (first, second) => {
      if (!pairs || shown === first + " " + second) return;
      shown = first + " " + second;
      const a = group.values(first), b = group.values(second);
      for (let i = 0; i < group.cellCount; ++i) { pairs[2 * i] = a[i]; pairs[2 * i + 1] = b[i]; }
      gl.bindBuffer(gl.ARRAY_BUFFER, values);
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, pairs);
    };
    const start = texture(), kept = [texture(), texture()];
    show(start, 0);
    return {
      array, start: start.made,
      /** The textures of two frames; one that is there already is not sent again. */
      frames(first, second) {
        if (!group.moves) return [start.made, start.made];
        if (kept[1].frame === first || kept[0].frame === second) kept.reverse();
        show(kept[0], first);
        show(kept[1], second);
        showValues(first, second);
        return kept.map(one => one.made);
      },
      showValues,
    };
  };

  const make = fields => {
    const canvas = document.createElement("canvas");
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "low-power" });
    if (!gl) return null;
    let programs, parts, latest = null;
    const begin = () => {
      programs = Object.fromEntries(Object.entries(shaders).map(([kind, sources]) => [kind, compiled(gl, sources)]));
      gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
      parts = fields.groups.map(group => uploaded(gl, group, programs[group.kind]));
    };
    begin();
    // A phone takes the context away when it needs the memory, and gives it back.
    canvas.addEventListener("webglcontextlost", event => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => { begin(); if (latest) draw(...latest); });

    const drawGroup = (group, part, style, picture) => {
      const { program, at } = programs[group.kind];
      const [first, second] = picture.frames, { eye } = picture;
      gl.useProgram(program);
      gl.bindVertexArray(part.array);
      const textures = part.frames(first, second);
      part.showValues(first, second);
      [...textures, part.start].forEach((texture, i) => {
        gl.activeTexture(gl.TEXTURE0 + i);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.uniform1i(at(["before", "after", "start"][i]), i);
      });
      gl.activeTexture(gl.TEXTURE0);
      gl.uniform1f(at("between"), picture.between);
      gl.uniform3fv(at("origin"), group.low.map((value, k) => value - eye.centre[k]));
      gl.uniform3fv(at("steps"), group.step);
      gl.uniformMatrix3fv(at("turn"), false, [0, 1, 2].flatMap(k => [eye.right[k], eye.up[k], eye.toward[k]]));
      gl.uniform3f(at("zoom"), 2 * eye.scale / canvas.width, 2 * eye.scale / canvas.height, -1 / eye.depth);
      gl.uniform2fv(at("shift"), [2 * eye.shift[0] / canvas.width, -2 * eye.shift[1] / canvas.height]);
      gl.uniform2f(at("pixels"), canvas.width, canvas.height);
      gl.uniform4f(at("colour"), ...rgb(style.colour), style.alpha);
      gl.uniform1i(at("colouring"), style.colouring);
      gl.uniform2fv(at("scale"), style.scale ?? [0, 1]);
      gl.uniform2fv(at("factors"), style.factors ?? [1, 1]);
      gl.uniform1f(at("reach"), style.reach ?? 1);
      gl.uniform1f(at("fading"), 0.55);
      gl.uniform1i(at("breaks"), group.breaks ? 1 : 0);
      gl.uniform3fv(at("ramp"), ramp.flatMap(rgb));
      gl.uniform1f(at("width"), style.width ?? 1);
      gl.uniform1f(at("smallest"), 1.5 / eye.scale);
      gl.drawArraysInstanced(group.kind === 3 ? gl.TRIANGLES : gl.TRIANGLE_STRIP, 0, group.kind === 3 ? 3 : 4, group.cellCount);
    };
    /** Faces that let through what is behind them come last and hide nothing. */
    const draw = (target, picture) => {
      latest = [target, picture];
      if (canvas.width !== target.width || canvas.height !== target.height) { canvas.width = target.width; canvas.height = target.height; }
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(1, 1, 1, 1);
      gl.depthMask(true);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      const drawn = fields.groups.map((group, i) => ({ group, part: parts[i], style: picture.style(group) })).filter(({ style }) => style);
      const solid = drawn.filter(({ style }) => style.alpha === 1), clear = drawn.filter(({ style }) => style.alpha < 1);
      gl.disable(gl.BLEND);
      solid.forEach(({ group, part, style }) => drawGroup(group, part, style, picture));
      gl.enable(gl.BLEND);
      gl.depthMask(false);
      clear.forEach(({ group, part, style }) => drawGroup(group, part, style, picture));
      const pen = target.getContext("2d");
      pen.drawImage(canvas, 0, 0);
    };
    return { draw };
  };
  make.ramp = ramp;
  return make;
})();
