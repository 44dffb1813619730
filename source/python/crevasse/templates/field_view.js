"use strict";

// Menu, sliders and colour bar of the field view; "number" is that of charts.js.

class FieldView {
  constructor(data, context) {
    this.data = data;
    this.context = context;
    this.part = (name) => document.getElementById(`field-${name}`);
    this.shown = {};
  }

  async start() {
    const { data, part } = this;
    await data.readMesh();
    part("lip").hidden = data.lip.length === 0;
    this.scene = new FieldScene(part("canvas"), this.context, data);
    for (const { name, label } of data.components)
      if (data.dimension === 3 || name !== "contact_pressure")
        part("component").add(new Option(label, name));
    part("instant").max = data.times.length - 1;
    part("instant").value = data.first;
    part("play").hidden = part("instant").hidden = data.times.length === 1;
    part("component").addEventListener("change", () => this.update());
    part("instant").addEventListener("input", () => this.update());
    part("factor").addEventListener("input", () => this.deform());
    const showCells = () => { this.scene.cells.visible = part("cells").checked; };
    showCells();
    part("cells").addEventListener("change", () => {
      showCells();
      this.scene.draw();
    });
    part("reset").addEventListener("click", () => this.scene.reset());
    part("play").addEventListener("click", () => this.play());
    part("canvas").addEventListener("pointermove", (event) => this.readOff(event));
    part("canvas").addEventListener("pointerleave", () => { part("value").textContent = ""; });
    new ResizeObserver(() => this.scene.resize()).observe(part("canvas").parentElement);
    this.deform();
    await this.update();
  }

  // The newest call wins; "ready" is for those who wait for it.
  update() {
    this.ready = this.show(Number(this.part("instant").value), this.part("component").value);
    return this.ready;
  }

  async show(instant, name) {
    const { data, part } = this;
    const ticket = this.ticket = {};
    const pressure = data.lip.length ? "contact_pressure" : null;
    const [displacement, values, pressures] = await Promise.all([
      data.displacement(instant), data.values(name, instant),
      pressure && data.values(pressure, instant)]);
    if (ticket !== this.ticket) return;
    this.scene.fill("displacement", displacement, 3);
    this.scene.fill("value", values, 1);
    const component = data.component(name);
    this.shown = { displacement, values, names: component.names };
    this.scene.paint(component);
    const least = pressure ? data.component(pressure).threshold : 0;
    this.scene.mark(data.lip.filter((i) => pressures[i] > least));
    this.scene.draw();
    this.drawBar(component);
    const t = data.times[instant];
    const words = `t = ${number(t)} = ${number(t / data.period, 4)} T`;
    part("time").textContent = words;
    part("instant").setAttribute("aria-valuetext", words);
    part("canvas").setAttribute("aria-label", `${component.label} on the ` +
      (data.still ? "body at rest" : `deformed body at ${words}`));
  }

  deform() {
    const factor = this.data.factor * Number(this.part("factor").value) / 10;
    const words = `× ${number(factor, 4)}`;
    this.scene.factor.value = factor;
    this.part("factor-shown").textContent = words;
    this.part("factor").setAttribute("aria-valuetext", words);
    this.scene.draw();
  }

  // The largest at the top; triangles where values go beyond the levels.
  drawBar({ label, levels, colours, low, quantum, names }) {
    const bar = this.part("bar");
    const beyond = names ? [] : [levels[0] > low + quantum, levels[levels.length - 1] < low + 65534 * quantum];
    const step = levels[1] - levels[0];
    const power = Math.floor(Math.log10(Math.max(...levels.map(Math.abs))) + 1e-9);
    const scaled = power < -2 || power > 4;
    const unit = scaled ? 10 ** power : 1;
    const words = levels.map((level) => number(Math.round(level / step) * step / unit, 4));
    bar.replaceChildren();
    const add = (kind, colour, text) => {
      const band = document.createElement("div");
      band.className = kind;
      band.style.setProperty("--colour", colour);
      band.append(document.createElement("span"));
      band.firstChild.textContent = text;
      bar.append(band);
    };
    const heading = document.createElement("p");
    heading.innerHTML = scaled ? `× 10<sup>${number(power)}</sup>` : "&nbsp;";
    bar.append(heading);
    const kind = names ? "band named" : "band";
    add(beyond[1] ? "beyond above" : "beyond", colours[colours.length - 1],
        names ? "" : words[words.length - 1]);
    for (let k = levels.length - 2; k >= 0; --k) add(kind, colours[k + 1], (names || words)[k]);
    add(beyond[0] ? "beyond below" : "beyond", colours[0], "");
    bar.setAttribute("aria-label", names ? `${label}: ${names.join(", ")}` :
      `${label}: colours from ${number(levels[0])} to ${number(levels[levels.length - 1])} ` +
      `in steps of ${number(step)}`);
  }

  async play() {
    const button = this.part("play");
    this.playing = !this.playing;
    button.textContent = this.playing ? "pause" : "play";
    button.setAttribute("aria-pressed", String(this.playing));
    const slider = this.part("instant");
    while (this.playing) {
      slider.value = (Number(slider.value) + 1) % this.data.times.length;
      await Promise.all([this.update(), new Promise((next) => setTimeout(next, 250))]);
    }
  }

  // The value at the node nearest to the pointer, in front of others.
  readOff(event) {
    const { data, scene, shown } = this;
    const box = event.target.getBoundingClientRect();
    const x = 2 * (event.clientX - box.left) / box.width - 1;
    const y = 1 - 2 * (event.clientY - box.top) / box.height;
    const reach = 2 * 60 / box.width, aspect = box.height / box.width;
    const m = new THREE.Matrix4().multiplyMatrices(scene.camera.projectionMatrix,
                                                   scene.camera.matrixWorldInverse).elements;
    let found = -1, best = Infinity;
    for (let i = 0; i < data.count; ++i) {
      const p = [0, 1, 2].map((k) => data.rest[3 * i + k] +
                                     scene.factor.value * shown.displacement[3 * i + k]);
      const at = (row) => m[row] * p[0] + m[row + 4] * p[1] + m[row + 8] * p[2] + m[row + 12];
      const distance = Math.hypot(at(0) - x, (at(1) - y) * aspect);
      if (distance > reach) continue;
      const score = distance + (data.dimension === 3 ? at(2) : 0);
      if (score < best) [best, found] = [score, i];
    }
    this.part("value").textContent = found < 0 ? "" : this.wordsAt(found);
  }

  wordsAt(node) {
    const { rest, dimension } = this.data;
    const { names, values } = this.shown;
    const place = [...rest.slice(3 * node, 3 * node + dimension)].map((x) => number(x, 4));
    const value = names ? names[Math.round(values[node])] : number(values[node], 4);
    return `${value} at (${place.join(", ")})`;
  }
}

async function startFieldView() {
  const canvas = document.getElementById("field-canvas");
  const context = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  const lacks = !context ? "WebGL 2"
    : typeof DecompressionStream === "undefined" ? "DecompressionStream" : null;
  if (lacks) {
    const trouble = document.getElementById("field-trouble");
    trouble.textContent = `This browser has no ${lacks}, which the field view needs. ` +
                          "The pictures below do not.";
    trouble.hidden = false;
    document.getElementById("field-view").hidden = true;
    return null;
  }
  const data = new FieldData(JSON.parse(document.getElementById("field-data").textContent));
  const view = new FieldView(data, context);
  await view.start();
  return view;
}

const fieldView = startFieldView();
