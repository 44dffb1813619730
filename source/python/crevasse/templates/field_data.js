"use strict";

// Shows what crevasse/field_view.py packed into the JSON element "field-data".

class FieldData {
  constructor(packed) {
    Object.assign(this, packed);
    this.names = ["displacement_1", "displacement_2", "displacement_3"]
      .slice(0, this.still ? 0 : this.dimension);
  }

  static async inflate(text) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // Numbers of several bytes, of which the lowest of all come first.
  static async numbers(text, width) {
    const bytes = await FieldData.inflate(text);
    const result = new Uint32Array(bytes.length / width);
    for (let k = 0, b = 0; k < width; ++k)
      for (let i = 0; i < result.length; ++i, ++b) result[i] |= bytes[b] << (8 * k);
    return result;
  }

  async readMesh() {
    const points = new Float32Array((await FieldData.numbers(this.points, 4)).buffer);
    this.count = points.length / this.dimension;
    this.rest = this.vectors((i, k) => points[i * this.dimension + k]);
    this.quads = await FieldData.numbers(this.quads, 4);
    for (let i = 0; i < this.quads.length; ++i)
      this.quads[i] = FieldData.signed(this.quads[i]) + (i < 4 ? 0 : this.quads[i - 4]);
    if (this.per_quad) this.separate();
    this.marks = await FieldData.numbers(this.marks, 1);
    const heights = (points) =>
      points.reduce((sum, i) => sum + this.rest[3 * i + 1], 0) / points.length;
    this.lip = (this.component("contact_pressure") || { lip: [] }).lip;
    this.lipBelow = heights(this.lip) < heights([...Array(this.count).keys()]);
  }

  // Gives each quadrilateral points of its own: values may jump between them.
  separate() {
    this.vertices = this.rest;
    this.corners = this.quads;
    this.count = this.quads.length;
    this.rest = this.vectors((i, k) => this.vertices[3 * this.corners[i] + k]);
    this.quads = this.quads.map((_, i) => i);
  }

  static signed(z) { return (z >>> 1) ^ -(z & 1); }

  vectors(value) {
    const result = new Float32Array(3 * this.count);
    for (let i = 0; i < this.count; ++i)
      for (let k = 0; k < this.dimension; ++k) result[3 * i + k] = value(i, k);
    return result;
  }

  component(name) { return this.components.find((c) => c.name === name); }

  async values(name, instant) {
    const { low, quantum, values } = this.component(name);
    const q = await FieldData.numbers(values[instant], 2);
    for (let i = 0, last = 0; i < q.length; ++i) q[i] = last = (last + FieldData.signed(q[i])) & 65535;
    if (!this.per_quad) return Float32Array.from(q, (x) => low + quantum * x);
    return Float32Array.from(this.quads, (i) => low + quantum * q[i >> 2]);
  }

  async displacement(instant) {
    const parts = await Promise.all(this.names.map((name) => this.values(name, instant)));
    return this.vectors((i, k) => (this.still ? 0 : parts[k][i]));
  }

  // Pairs of points at the edges of cells (bit 0) or of the outline (bit 4).
  edges(bit) {
    const ends = [];
    this.marks.forEach((mark, q) => {
      for (let k = 0; k < 4; ++k)
        if (mark >> (bit + k) & 1)
          ends.push(this.quads[4 * q + k], this.quads[4 * q + (k + 1) % 4]);
    });
    return ends;
  }
}

// The surface, finer than its quadrilaterals where these are few: the values are
// bilinear on them, on triangles they are not.
class Patches {
  constructor(data) {
    const count = data.quads.length / 4;
    const n = Math.max(1, Math.min(12, Math.round(Math.sqrt(30000 / count))));
    this.quads = data.quads;
    this.weights = [];
    for (let j = 0; j <= n; ++j)
      for (let i = 0; i <= n; ++i) {
        const [x, y] = [i / n, j / n];
        this.weights.push([(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y]);
      }
    const own = [];
    for (let j = 0; j < n; ++j)
      for (let i = 0; i < n; ++i) {
        const a = i + j * (n + 1), c = a + n + 2;
        own.push(a, a + 1, c, a, c, c - 1);
      }
    this.index = new Uint32Array(count * own.length);
    for (let q = 0; q < count; ++q)
      for (let k = 0; k < own.length; ++k)
        this.index[q * own.length + k] = q * this.weights.length + own[k];
  }

  spread(values, size) {
    const { quads, weights } = this;
    const result = new Float32Array(quads.length / 4 * weights.length * size);
    for (let q = 0, r = 0; q < quads.length; q += 4)
      for (const w of weights)
        for (let c = 0; c < size; ++c, ++r)
          result[r] = w[0] * values[quads[q] * size + c] + w[1] * values[quads[q + 1] * size + c] +
                      w[2] * values[quads[q + 2] * size + c] + w[3] * values[quads[q + 3] * size + c];
    return result;
  }
}
