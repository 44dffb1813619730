"use strict";

// Draws what the report's Python modules describe in the JSON element "data".

const data = JSON.parse(document.getElementById("data").textContent);
const OPEN_TO_CLOSED = ["#ffffff", "#e9e9e9", "#c4c4c4"];

Chart.defaults.font.family = '"DejaVu Sans", system-ui, sans-serif';
Chart.defaults.color = "#222222";
Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;

function number(value, digits = 5) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size < 1e-4 || size >= 1e6
    ? value.toExponential(digits - 1).replace(/\.?0*e\+?/, "e")
    : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, "\u2212");
}

function axis(title, logarithmic) {
  return {
    type: logarithmic ? "logarithmic" : "linear",
    title: { display: true, text: title },
    grid: { color: "#eeeeee" },
    ticks: {
      maxRotation: 0,
      callback: (value, index, all) => {
        if (!logarithmic) return number(value, 6);
        const span = all[all.length - 1].value / all[0].value;
        const mantissas = span > 100 ? [1] : span > 4 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 7];
        const mantissa = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
        return mantissas.some((m) => Math.abs(mantissa - m) < 1e-6)
          ? number(value, 6) : null;
      },
    },
  };
}

// Grey where the crack lip is partly or wholly closed.
const lipStates = {
  id: "lipStates",
  beforeDraw(chart) {
    const { ctx, chartArea, scales } = chart;
    if (!chart.options.plugins.lipStates.shown) return;
    ctx.save();
    ctx.beginPath();
    ctx.rect(chartArea.left, chartArea.top, chartArea.width, chartArea.height);
    ctx.clip();
    for (const [begin, end, state] of data.shades) {
      const left = scales.x.getPixelForValue(begin);
      ctx.fillStyle = OPEN_TO_CLOSED[state];
      ctx.fillRect(left, chartArea.top, scales.x.getPixelForValue(end) - left,
                   chartArea.height);
    }
    ctx.restore();
  },
};

// A band of the error bars around each curve in the last period.
const errorBars = {
  id: "errorBars",
  beforeDatasetsDraw(chart) {
    const { ctx, chartArea, scales } = chart;
    const { bars, period } = chart.options.plugins.errorBars;
    ctx.save();
    ctx.beginPath();
    ctx.rect(chartArea.left, chartArea.top, chartArea.width, chartArea.height);
    ctx.clip();
    ctx.globalAlpha = 0.2;
    chart.data.datasets.forEach(({ data: all, borderColor }, k) => {
      if (!bars[k] || !chart.isDatasetVisible(k)) return;
      const begin = all[all.length - 1].x - 1.000001 * period;
      const points = all.filter(({ x }) => x >= begin);
      const edge = (way) => points.map(({ x, y }) => [
        scales.x.getPixelForValue(x), scales.y.getPixelForValue(y + way * bars[k])]);
      ctx.beginPath();
      for (const place of [...edge(1), ...edge(-1).reverse()]) ctx.lineTo(...place);
      ctx.fillStyle = borderColor;
      ctx.fill();
    });
    ctx.restore();
  },
};

// A vertical line of the error bar through each point that has one.
const whiskers = {
  id: "whiskers",
  afterDatasetsDraw(chart) {
    const { ctx, scales } = chart;
    chart.data.datasets.forEach(({ data: all, borderColor }, k) => {
      if (!chart.isDatasetVisible(k)) return;
      ctx.strokeStyle = borderColor;
      all.forEach(({ y, bar }, i) => {
        if (!bar) return;
        const { x } = chart.getDatasetMeta(k).data[i];
        const [top, bottom] = [y + bar, y - bar].map((end) => scales.y.getPixelForValue(end));
        ctx.beginPath();
        for (const end of [top, bottom]) { ctx.moveTo(x - 3, end); ctx.lineTo(x + 3, end); }
        ctx.moveTo(x, top); ctx.lineTo(x, bottom);
        ctx.stroke();
      });
    });
  },
};

function stateAt(t) {
  const found = data.shades.find(([begin, end]) => begin <= t && t <= end);
  return ["lip open", "lip partly closed", "lip closed"][found ? found[2] : 0];
}

// Ticks at parts of the period that are easy to read.
function periodTicks(scale, period) {
  const span = scale.max - scale.min;
  const steps = [0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 5000];
  const step = period * (steps.find((part) => span / (part * period) <= 9) || span);
  const first = Math.ceil(scale.min / step - 1e-6);
  const last = Math.floor(scale.max / step + 1e-6);
  scale.ticks = [];
  for (let k = first; k <= last; ++k) scale.ticks.push({ value: k * step });
}

function datasetsOf(spec, view) {
  return spec.series.map((series, k) => ({
    label: series.label, borderColor: series.colour,
    backgroundColor: series.colour, borderWidth: 1.6,
    pointRadius: view.t.length > 80 ? 0 : 1.5, pointHoverRadius: 4,
    data: view.t.map((t, i) => ({ x: t, y: view.values[k][i] })),
  }));
}

function drawHistory(spec, canvas) {
  const time = axis("time t", false);
  const { whole } = spec.views;
  time.afterBuildTicks = (scale) => periodTicks(scale, spec.period);
  time.min = whole.t[0];
  time.max = whole.t[whole.t.length - 1];
  const values = axis(spec.y, spec.log);
  values.beginAtZero = spec.from_zero; // ticks around a constant would be alike
  const chart = new Chart(canvas, {
    type: "line",
    data: { datasets: datasetsOf(spec, whole) },
    plugins: [lipStates, errorBars],
    options: {
      parsing: false, normalized: true,
      interaction: { mode: "nearest", axis: "x", intersect: false },
      scales: { x: time, y: values },
      plugins: {
        lipStates: { shown: data.lip },
        errorBars: { bars: spec.bars || [], period: spec.period },
        legend: { display: spec.series.length > 1,
                  labels: { boxWidth: 18, boxHeight: 2 } },
        tooltip: { callbacks: {
          title: (items) => {
            const t = items[0].parsed.x;
            const period = Math.floor(t / spec.period + 1e-9);
            const within = t - period * spec.period;
            return `t = ${number(t, 7)}` +
              (period ? ` (period ${period + 1}: ${number(within)})` : "") +
              (data.lip ? `, ${stateAt(t)}` : "");
          },
          label: (item) => `${item.dataset.label} = ${number(item.parsed.y)}`,
        } },
      },
    },
  });
  chart.showView = (name) => {
    const view = spec.views[name] || whole;
    chart.options.scales.x.min = view.t[0];
    chart.options.scales.x.max = view.t[view.t.length - 1];
    datasetsOf(spec, view).forEach((dataset, k) =>
      Object.assign(chart.data.datasets[k], dataset));
    chart.update();
  };
  return chart;
}

function drawPoints(spec, canvas) {
  const logarithmic = spec.log || [];
  const across = axis(spec.x, logarithmic.includes("x"));
  if (spec.whole) across.ticks.precision = 0;
  if (spec.categories)
    Object.assign(across, { type: "category", labels: spec.categories, offset: true,
                            ticks: { maxRotation: 60 } });
  const up = axis(spec.y, logarithmic.includes("y"));
  const ends = spec.series.flatMap(({ points }) => points.filter((point) => point[4])
    .flatMap(([, y, , , bar]) => [y - bar, y + bar]));
  if (ends.length && !logarithmic.includes("y"))
    [up.suggestedMin, up.suggestedMax] = [Math.min(...ends), Math.max(...ends)];
  return new Chart(canvas, {
    type: "scatter",
    data: { datasets: spec.series.map((series) => ({
      label: series.label, borderColor: series.colour,
      backgroundColor: series.hollow ? "transparent" : series.colour,
      pointBackgroundColor: series.hollow ? "transparent"
        : series.points.map((point) => point[3] ? "#ffffff" : series.colour),
      showLine: !series.loose, borderWidth: series.hollow ? 2 : 1.5,
      borderDash: series.bare ? [6, 4] : [], stepped: series.stepped || false,
      pointRadius: series.bare ? 0 : series.hollow ? 8 : 4,
      pointHoverRadius: series.bare ? 0 : series.hollow ? 8 : 6,
      pointStyle: series.bare ? "line" : series.marker || "circle",
      data: series.points.map(([x, y, words, , bar]) => ({ x, y, words, bar })),
    })) },
    plugins: [whiskers],
    options: {
      interaction: { mode: "nearest", intersect: false },
      scales: { x: across, y: up },
      plugins: {
        // Longer legends stand beside the chart; the longest leave no room for it.
        legend: { display: spec.series.length > 1 && spec.series.length <= 16,
                  position: spec.series.length > 7 ? "right" : "top",
                  labels: { usePointStyle: true, boxHeight: 7 } },
        tooltip: {
          filter: (item) => !spec.series[item.datasetIndex].hollow &&
                            !spec.series[item.datasetIndex].bare,
          callbacks: {
            title: (items) => items.length ? items[0].dataset.label : "",
            label: (item) => [...(item.raw.words || []),
                              ...(spec.what ? [] : [`${spec.x}: ${number(item.parsed.x)}`]),
                              `${spec.what || spec.y}: ${number(item.parsed.y)}` +
                                (item.raw.bar ? ` ± ${number(item.raw.bar, 2)}` : "")],
          },
        },
      },
    },
  });
}

const charts = data.charts.map((spec) => {
  const canvas = document.getElementById(spec.id);
  return spec.kind === "history" ? drawHistory(spec, canvas)
                                 : drawPoints(spec, canvas);
});

function show(name) {
  for (const chart of charts) if (chart.showView) chart.showView(name);
  for (const button of document.querySelectorAll("button[data-view]"))
    button.setAttribute("aria-pressed", String(button.dataset.view === name));
}

for (const button of document.querySelectorAll("button[data-view]"))
  button.addEventListener("click", () => show(button.dataset.view));

// Sweeps: one quantity at a time.
for (const choice of document.querySelectorAll("select[data-shows]")) {
  const choose = () => {
    for (const part of document.querySelectorAll(choice.dataset.shows))
      part.hidden = part.dataset.quantity !== choice.value;
    for (const chart of charts) chart.resize();
  };
  choice.addEventListener("change", choose);
  choose();
}
