"use strict";

// Shows boundaries, supports, probes, crack tips and the worst cells of what
// crevasse/picture.py packed, over the field view.

// A strip beside a line, on its left, of a width in pixels.
const STRIP = `
  uniform vec2 viewport;
  uniform float width;
  attribute vec3 along;
  attribute float side;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    vec2 seen = normalize((projectionMatrix * modelViewMatrix * vec4(along, 0.0)).xy * viewport);
    gl_Position.xy += 2.0 * side * width * vec2(-seen.y, seen.x) / viewport;
    gl_Position.z -= 1.5e-3;
  }`;

class MeshMarks {
  constructor(view) {
    Object.assign(this, { data: view.data, scene: view.scene });
    this.viewport = { value: new THREE.Vector2(1, 1) };
    this.svg = document.getElementById("mesh-marks");
    this.hidden = new Set();
  }

  async start() {
    const { data, scene } = this;
    this.groups = await Promise.all(data.groups.map(async (group) => {
      const parts = await FieldData.numbers(group.parts, 4);
      const object = scene.add(data.dimension === 2 ? this.strip(group, parts)
                                                    : this.faces(group, parts));
      object.parts = parts;
      return object;
    }));
    for (const box of document.querySelectorAll("input[data-marks]")) {
      const change = () => {
        const { marks } = box.dataset;
        if (this.groups[marks]) this.groups[marks].visible = box.checked;
        else this.hidden[box.checked ? "delete" : "add"](marks);
      };
      change();
      box.addEventListener("change", () => { change(); scene.draw(); });
    }
    for (const button of document.querySelectorAll("button[data-place]"))
      button.addEventListener("click", () => this.lookAt(JSON.parse(button.dataset.place),
                                                         Number(button.dataset.size)));
    scene.beforeDraw = () => this.update();
    scene.draw();
    return this;
  }

  geometry(arrays, index) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, size] of [["position", 3], ["along", 3], ["side", 1]])
      if (arrays[name])
        geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(arrays[name]), size));
    geometry.setIndex(index);
    return geometry;
  }

  vertex(i) { return this.data.vertices.slice(3 * i, 3 * i + 3); }

  strip({ colour, kind }, ends) {
    const position = [], along = [], side = [], index = [];
    for (let i = 0; i < ends.length; i += 2) {
      const [a, b] = [this.vertex(ends[i]), this.vertex(ends[i + 1])];
      index.push(...[0, 1, 2, 2, 1, 3].map((k) => 2 * i + k));
      for (const end of [a, b])
        for (const s of [0, 1]) {
          position.push(...end);
          along.push(...b.map((x, k) => x - a[k]));
          side.push(s);
        }
    }
    return new THREE.Mesh(this.geometry({ position, along, side }, index), new THREE.ShaderMaterial({
      vertexShader: STRIP, fragmentShader: PLAIN, side: THREE.DoubleSide,
      uniforms: { viewport: this.viewport, width: { value: kind === "free" ? 2.5 : 5 },
                  colour: { value: new THREE.Color(colour) }, disc: { value: 0 },
                  opacity: { value: 1 } } }));
  }

  // Faces in space; the lips of a crack are seen through the body.
  faces({ colour, kind }, quads) {
    const position = [], index = [];
    for (const q of quads) {
      const first = position.length / 3;
      for (let k = 0; k < 4; ++k) position.push(...this.vertex(this.data.corners[4 * q + k]));
      index.push(...[0, 1, 2, 0, 2, 3].map((k) => first + k));
    }
    const within = kind === "Crack" || kind === "Contact";
    const material = this.scene.material(PLAIN, {
      colour: { value: new THREE.Color(colour) }, disc: { value: 0 },
      closer: { value: 5e-4 }, opacity: { value: within ? 0.5 : 0.75 } });
    Object.assign(material, { depthTest: !within, depthWrite: false });
    return new THREE.Mesh(this.geometry({ position }, index), material);
  }

  // Place in the picture, in pixels.
  project(point) {
    const p = new THREE.Vector3(...point, ...(point.length < 3 ? [0] : []));
    p.project(this.scene.camera);
    return [(p.x + 1) / 2 * this.viewport.value.x, (1 - p.y) / 2 * this.viewport.value.y];
  }

  update() {
    const { clientWidth, clientHeight } = this.scene.canvas.parentElement;
    this.viewport.value.set(clientWidth, clientHeight);
    this.svg.replaceChildren();
    this.labels = [];
    const { front, fixed, probes, worst, dimension } = this.data;
    const kinds = {
      front: () => {
        for (const [a, b] of front) {
          if (dimension === 3) this.path("front", [[a, b]]);
          else this.point("front", a, "M-5-5L5 5M-5 5L5-5", "crack tip");
        }
      },
      fixed: () => fixed.forEach((support) => this.support(support)),
      probes: () => probes.forEach(({ name, point }) =>
        this.point("probes", point, "M-4 0A4 4 0 1 0 4 0A4 4 0 1 0-4 0", name)),
      worst: () => {
        for (const { corners } of worst)
          this.path("worst", corners.flatMap((corner, i) => [1, 2, 4].filter((bit) =>
            bit < corners.length && !(i & bit)).map((bit) => [corner, corners[i | bit]])));
        this.point("worst", worst[0].point, "", `quality ${number(worst[0].quality, 3)}`);
      },
    };
    for (const [kind, show] of Object.entries(kinds))
      if (this.data[kind].length > 0 && !this.hidden.has(kind)) show();
  }

  // An arrow along each held direction.
  support({ point, components, held }) {
    const [x, y] = this.project(point);
    components.forEach((isHeld, k) => {
      const [u, v] = this.project(point.map((c, d) => c - (d === k ? this.unit() : 0)));
      if (isHeld && Math.hypot(u - x, v - y) > 4) {
        const angle = Math.atan2(y - v, x - u) * 180 / Math.PI;
        this.element("path", { class: "fixed", d: `M${u - x} ${v - y}L0 0`,
                               transform: `translate(${x} ${y})` });
        this.element("path", { class: "fixed", d: "M-8-4L0 0L-8 4",
                               transform: `translate(${x} ${y}) rotate(${angle})` });
      }
    });
    this.point("fixed", point, "", held.join(" = ") + " = 0");
  }

  // Length that is seen as 24 pixels.
  unit() { return 48 / this.viewport.value.y * this.scene.camera.top / this.scene.camera.zoom; }

  point(kind, place, d, text) {
    const [x, y] = this.project(place);
    if (d) this.element("path", { class: kind, d, transform: `translate(${x} ${y})` });
    const end = x > 0.8 * this.viewport.value.x;
    let line = y - 6; // above labels at the same place
    while (this.labels.some(([u, v]) => Math.abs(x - u) < 60 && Math.abs(line - v) < 14)) line -= 14;
    this.labels.push([x, line]);
    this.element("text", { class: kind, x: x + (end ? -8 : 8), y: line,
                           "text-anchor": end ? "end" : "start" }).textContent = text;
  }

  path(kind, edges) {
    this.element("path", { class: kind, d: edges.map((ends) =>
      "M" + ends.map((end) => this.project(end).join(" ")).join("L")).join("") });
  }

  element(name, attributes) {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    this.svg.append(element);
    return element;
  }

  // Brings a place into the middle; around it is seen eight times the size.
  lookAt(place, size) {
    const { camera, controls, box } = this.scene;
    const to = new THREE.Vector3(...place, ...(place.length < 3 ? [0] : []));
    camera.position.add(to).sub(controls.target);
    controls.target.copy(to);
    camera.zoom = Math.max(1, box.getSize(new THREE.Vector3()).length() / (8 * size));
    camera.updateProjectionMatrix();
    controls.update();
    this.scene.draw();
    this.scene.canvas.scrollIntoView({ block: "nearest" });
  }
}

const meshMarks = fieldView.then((view) => view && new MeshMarks(view).start());
