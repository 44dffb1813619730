"use strict";

// Draws the surface, its edges and the nodes that press, deformed on the GPU.

const DEFORM = `
  uniform float factor, closer, size;
  attribute vec3 displacement;
  attribute float value;
  varying float v;
  varying vec3 place;
  void main() {
    v = value;
    vec4 seen = modelViewMatrix * vec4(position + factor * displacement, 1.0);
    place = seen.xyz;
    gl_Position = projectionMatrix * seen;
    gl_Position.z -= closer;
    gl_PointSize = size;
  }`;
const BANDS = `
  uniform sampler2D palette;
  uniform float low, inverse, bands, shaded, zero;
  varying float v;
  varying vec3 place;
  void main() {
    float x = (v - low) * inverse + 1.0;
    float band = clamp(floor(x), 0.0, bands - 1.0);
    vec3 colour = texture2D(palette, vec2((band + 0.5) / bands, 0.5)).rgb;
    float line = abs(x - floor(x + 0.5)) / max(fwidth(x), 1e-6);
    if (abs(v) <= zero && fwidth(v) <= zero) colour = vec3(0.97);  // no more than rounding
    else if (x > 0.5 && x < bands - 0.5 && fwidth(x) > 1e-5) colour *= mix(0.72, 1.0, clamp(line, 0.0, 1.0));
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    float light = 0.84 + 0.16 * abs(dot(normal, normalize(vec3(0.2, 0.5, 1.0))));
    gl_FragColor = vec4(mix(1.0, light, shaded) * colour, 1.0);
  }`;
const PLAIN = `
  uniform vec3 colour;
  uniform float disc, opacity;
  void main() {
    if (disc > 0.5 && length(gl_PointCoord - 0.5) > 0.5) discard;
    gl_FragColor = vec4(colour, opacity);
  }`;

class FieldScene {
  constructor(canvas, context, data) {
    this.canvas = canvas;
    this.data = data;
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.setClearColor(0xffffff);
    this.scene = new THREE.Scene();
    this.factor = { value: data.factor };
    this.nodes = this.geometry(data.rest);
    this.patches = new Patches(data);
    this.surface = this.geometry(this.patches.spread(data.rest, 3));
    this.surface.setIndex(new THREE.BufferAttribute(this.patches.index, 1));
    this.bands = {
      palette: { value: null }, low: { value: 0 }, inverse: { value: 1 }, bands: { value: 1 },
      shaded: { value: data.dimension - 2 }, zero: { value: 0 },
    };
    this.add(new THREE.Mesh(this.surface, this.material(BANDS, this.bands)));
    this.cells = this.lines(data.edges(0), 0x111111, 1e-3);
    this.cells.visible = false;
    this.cells.material.uniforms.opacity.value = 0.4;
    this.lines(data.edges(4), 0x111111, 1.2e-3);
    if (data.dimension === 2)
      this.lines(data.edges(4), 0xb0b0b0, -1e-2).material.uniforms.factor = { value: 0 };
    this.pressed = this.add(new THREE.Points(this.share(), this.material(PLAIN, {
      colour: { value: new THREE.Color(0xd000d0) }, disc: { value: 1 },
      closer: { value: 4e-3 }, size: { value: 6 * devicePixelRatio } })));
    this.pressed.geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(data.lip.length), 1));
    this.placeCamera();
  }

  geometry(rest) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(rest, 3));
    for (const [name, size] of [["displacement", 3], ["value", 1]])
      geometry.setAttribute(name, new THREE.BufferAttribute(
        new Float32Array(rest.length / 3 * size), size));
    return geometry;
  }

  // The nodes with an index of its own.
  share() {
    const geometry = new THREE.BufferGeometry();
    Object.assign(geometry.attributes, this.nodes.attributes);
    return geometry;
  }

  material(fragmentShader, uniforms) {
    return new THREE.ShaderMaterial({
      vertexShader: DEFORM, fragmentShader, side: THREE.DoubleSide,
      extensions: { derivatives: true },
      transparent: fragmentShader === PLAIN,
      uniforms: { factor: this.factor, closer: { value: 0 }, size: { value: 1 },
                  opacity: { value: 1 }, ...uniforms },
    });
  }

  add(object) {
    object.frustumCulled = false;
    this.scene.add(object);
    return object;
  }

  lines(ends, colour, closer) {
    const geometry = this.share();
    geometry.setIndex(ends);
    return this.add(new THREE.LineSegments(geometry, this.material(PLAIN, {
      colour: { value: new THREE.Color(colour) }, disc: { value: 0 },
      closer: { value: closer } })));
  }

  // Sees the body at rest and, by the factor at the beginning, as it moves.
  placeCamera() {
    const { data } = this;
    const low = [0, 0, 0], high = [0, 0, 0];
    for (let k = 0; k < data.dimension; ++k) {
      const moved = data.component(data.names[k]) || { low: 0, quantum: 0 };
      low[k] = Infinity;
      high[k] = -Infinity;
      for (let i = k; i < data.rest.length; i += 3) {
        low[k] = Math.min(low[k], data.rest[i]);
        high[k] = Math.max(high[k], data.rest[i]);
      }
      low[k] += data.factor * Math.min(0, moved.low);
      high[k] += data.factor * Math.max(0, moved.low + 65535 * moved.quantum);
    }
    this.box = new THREE.Box3(new THREE.Vector3(...low), new THREE.Vector3(...high));
    const size = this.box.getSize(new THREE.Vector3()).length();
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 6 * size);
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    Object.assign(this.controls, { enableKeys: false, enableZoom: false,
                                   enableRotate: data.dimension === 3,
                                   screenSpacePanning: true });
    if (data.dimension === 2) {
      this.controls.mouseButtons.LEFT = THREE.MOUSE.PAN;
      this.controls.touches = { ONE: THREE.TOUCH.PAN, TWO: THREE.TOUCH.DOLLY_PAN };
    }
    this.controls.addEventListener("change", () => this.draw());
    this.canvas.addEventListener("focus", () => { this.controls.enableZoom = true; });
    this.canvas.addEventListener("blur", () => { this.controls.enableZoom = false; });
    this.canvas.addEventListener("touchstart", () => { this.controls.enableZoom = true; },
                                 { capture: true });
    this.reset();
  }

  reset() {
    const centre = this.box.getCenter(new THREE.Vector3());
    const size = this.box.getSize(new THREE.Vector3()).length();
    const from = this.data.dimension === 2 ? [0, 0, 1] : [0.75, this.data.lipBelow ? -0.5 : 0.5, 1];
    this.camera.position.set(...from).setLength(3 * size).add(centre);
    this.controls.target.copy(centre);
    this.camera.zoom = 1;
    this.controls.update();
    this.camera.updateMatrixWorld();
    this.reach = this.box.clone().applyMatrix4(this.camera.matrixWorldInverse).max;
    // In space there is room to turn the body.
    if (this.data.dimension === 3)
      this.reach.max(new THREE.Vector3(1, 1, 1).multiplyScalar(0.44 * size));
    this.resize();
  }

  // The body fills the canvas, at whatever shape the canvas has.
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(width, height);
    const half = 1.04 * Math.max(this.reach.y, this.reach.x * height / width);
    Object.assign(this.camera, { top: half, bottom: -half,
                                 right: half * width / height, left: -half * width / height });
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.camera.updateMatrixWorld();
    if (this.beforeDraw) this.beforeDraw();
    this.renderer.render(this.scene, this.camera);
  }

  fill(name, values, size) {
    this.nodes.attributes[name].copyArray(values).needsUpdate = true;
    this.surface.attributes[name].copyArray(this.patches.spread(values, size)).needsUpdate = true;
  }

  mark(nodes) {
    const { index } = this.pressed.geometry;
    index.array.set(nodes);
    index.needsUpdate = true;
    this.pressed.geometry.setDrawRange(0, nodes.length);
  }

  paint({ levels, colours, quantum, names }) {
    const bytes = new Uint8Array(4 * colours.length);
    colours.forEach((colour, k) => {
      const { r, g, b } = new THREE.Color(colour);
      bytes.set([r, g, b, 1].map((part) => Math.round(255 * part)), 4 * k);
    });
    if (this.bands.palette.value) this.bands.palette.value.dispose();
    this.bands.palette.value = new THREE.DataTexture(bytes, colours.length, 1);
    this.bands.palette.value.needsUpdate = true;
    this.bands.zero.value = names ? -1 : 2 * quantum;
    this.bands.low.value = levels[0];
    this.bands.inverse.value = (levels.length - 1) / (levels[levels.length - 1] - levels[0]);
    this.bands.bands.value = colours.length;
  }
}
