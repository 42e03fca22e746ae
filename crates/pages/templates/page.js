"use strict";
(() => {
  const all = (root, what) => [...root.querySelectorAll(what)];
  const make = (svg, name, attributes) => {
    const element = document.createElementNS(svg.namespaceURI, name);
    for (const key in attributes) element.setAttribute(key, attributes[key]);
    return element;
  };
  const told = (value, span) => {
    const decimals = Math.min(6, Math.max(0, 2 - Math.floor(Math.log10(span))));
    return value.toFixed(decimals);
  };

  // Plots: the outer svg is the area between the axes, the inner one holds the curves.
  const plots = all(document, "svg.plot").map((svg) => {
    const inner = svg.querySelector("svg");
    const [, , width, height] = inner.getAttribute("viewBox").split(" ").map(Number);
    const [x, y] = [svg.dataset.x, svg.dataset.y].map((ends) => ends.split(" ").map(Number));
    return { svg, inner, width, height, x, y, shown: x };
  });
  const beside = (plot) => plots.filter((other) => {
    const figure = plot.svg.closest("figure");
    return other === plot || (figure && other.svg.closest("figure") === figure);
  });

  const ticks = (low, high) => {
    const wanted = (high - low) / 5, power = 10 ** Math.floor(Math.log10(wanted));
    const step = power * [1, 2, 5, 10].find((digit) => digit * power >= 0.999 * wanted);
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const numbers = [];
    for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; n++) {
      numbers.push([n * step, (n * step).toFixed(decimals)]);
    }
    return numbers;
  };
  const draw = (plot) => {
    const [low, high] = plot.shown, [start, end] = plot.x, scale = plot.width / (end - start);
    const box = [(low - start) * scale, 0, (high - low) * scale, plot.height];
    plot.inner.setAttribute("viewBox", box.join(" "));
    const group = plot.svg.querySelector(".ticks"), old = group.querySelector("line, text");
    const [line, text] = ["line", "text"].map((name) => group.querySelector(name) || old);
    const marks = ticks(low, high).flatMap(([value, label]) => {
      const at = `${100 * (value - low) / (high - low)}%`;
      const [grid, number] = [line.cloneNode(), text.cloneNode()];
      grid.setAttribute("x1", at);
      grid.setAttribute("x2", at);
      number.setAttribute("x", at);
      number.textContent = label;
      return [grid, number];
    });
    group.replaceChildren(...marks);
  };
  const zoom = (plot, low, high) => {
    const [start, end] = plot.x, least = (end - start) / 500;
    if (high - low < least) return;
    const shift = Math.max(0, start - low) - Math.max(0, high - end);
    const shown = [Math.max(start, low + shift), Math.min(end, high + shift)];
    for (const other of beside(plot)) {
      other.shown = shown;
      draw(other);
    }
  };

  const curves = (plot) => plot.curves ??= all(plot.inner, "path[data-name]").map((path) => {
    const numbers = path.getAttribute("d").match(/-?[\d.]+/g).map(Number);
    const points = [];
    for (let i = 0; i + 1 < numbers.length; i += 2) points.push([numbers[i], numbers[i + 1]]);
    return { name: path.dataset.name, colour: path.getAttribute("stroke"), points };
  });
  const at = (plot, points, value) => {
    const [start, end] = plot.x, px = plot.width * (value - start) / (end - start);
    let next = points.findIndex((point) => point[0] >= px);
    if (next < 0 || (next === 0 && points[0][0] - px > 1)) return null;
    const [a, b] = [points[Math.max(0, next - 1)], points[next]];
    const share = b[0] > a[0] ? (px - a[0]) / (b[0] - a[0]) : 0;
    const [low, high] = plot.y, y = a[1] + share * (b[1] - a[1]);
    return high - (high - low) * y / plot.height;
  };
  const box = document.createElement("div");
  box.className = "values";
  box.hidden = true;
  document.body.append(box);
  const leave = () => {
    box.hidden = true;
    all(document, ".cursor").forEach((line) => line.remove());
  };
  const point = (plot, share, place) => {
    leave();
    const value = plot.shown[0] + share * (plot.shown[1] - plot.shown[0]);
    const lines = [`${told(value, plot.shown[1] - plot.shown[0])} ${plot.svg.dataset.xUnit}`];
    const rows = [];
    for (const other of beside(plot)) {
      const x = `${100 * share}%`;
      other.svg.append(make(other.svg, "line", { class: "cursor", x1: x, x2: x, y2: "100%" }));
      for (const { name, colour, points } of curves(other)) {
        const y = at(other, points, value);
        if (y !== null) rows.push([colour, `${told(y, other.y[1] - other.y[0])} ${other.svg.dataset.yUnit}`, name]);
      }
    }
    box.replaceChildren(...[["", lines[0], ""], ...rows].map(([colour, number, name]) => {
      const row = document.createElement("div"), chip = document.createElement("i");
      chip.style.background = colour || "none";
      row.append(chip, `${number} ${name}`);
      return row;
    }));
    box.hidden = false;
    const left = Math.min(place[0] + 14, innerWidth - box.offsetWidth - 6);
    box.style.left = `${Math.max(4, left)}px`;
    box.style.top = `${Math.min(place[1] + 14, innerHeight - box.offsetHeight - 6)}px`;
  };

  for (const plot of plots) {
    const { svg } = plot;
    let from = null, chosen = null;
    const share = (event) => {
      const area = svg.getBoundingClientRect();
      return Math.min(1, Math.max(0, (event.clientX - area.left) / area.width));
    };
    const end = () => {
      from = null;
      chosen?.remove();
      chosen = null;
    };
    svg.tabIndex = 0;
    svg.addEventListener("pointerdown", (event) => {
      from = share(event);
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", (event) => {
      const now = share(event);
      point(plot, now, [event.clientX, event.clientY]);
      if (from === null) return;
      chosen ??= svg.appendChild(make(svg, "rect", { class: "chosen", height: "100%" }));
      chosen.setAttribute("x", `${100 * Math.min(from, now)}%`);
      chosen.setAttribute("width", `${100 * Math.abs(now - from)}%`);
    });
    svg.addEventListener("pointerup", (event) => {
      const [a, b] = [from, share(event)].sort((p, q) => p - q);
      const [low, high] = plot.shown, span = high - low;
      if (from !== null && b - a > 0.02) zoom(plot, low + a * span, low + b * span);
      end();
    });
    svg.addEventListener("pointercancel", end);
    svg.addEventListener("pointerleave", leave);
    svg.addEventListener("blur", leave);
    svg.addEventListener("dblclick", () => zoom(plot, ...plot.x));
    svg.addEventListener("keydown", (event) => {
      const [low, high] = plot.shown, span = high - low;
      const moves = {
        "+": [0.25, -0.25], "-": [-0.5, 0.5], ArrowLeft: [-0.2, -0.2], ArrowRight: [0.2, 0.2],
      };
      const move = event.key === "0" ? [-1e9, 1e9] : moves[event.key];
      if (!move) return;
      event.preventDefault();
      zoom(plot, Math.max(plot.x[0] - span, low + move[0] * span), Math.min(plot.x[1] + span, high + move[1] * span));
    });
  }

  // Tables: a click on a heading sorts by its column, up, down and as it was.
  for (const table of all(document, "table")) {
    const body = table.tBodies[0], rows = body ? [...body.rows] : [];
    if (rows.length < 2 || body.querySelector("[colspan]")) continue;
    const heads = [...table.tHead?.rows[0]?.cells ?? []];
    const key = (row, column) => {
      const text = row.cells[column]?.textContent.trim() ?? "";
      const number = parseFloat(text.replace("−", "-").replace(/^[<>≥≤≈~]\s*/, ""));
      return [!isFinite(number), number, text];
    };
    const order = (a, b) => a[0] - b[0] || (a[0] ? a[2].localeCompare(b[2]) : a[1] - b[1]);
    heads.forEach((head, column) => {
      if (!head.textContent.trim()) return;
      head.tabIndex = 0;
      head.className += " sorts";
      const sort = () => {
        const next = { "": "ascending", ascending: "descending", descending: "" }[head.ariaSort ?? ""];
        heads.forEach((other) => other.removeAttribute("aria-sort"));
        if (next) head.setAttribute("aria-sort", next);
        const sign = next === "descending" ? -1 : 1;
        const sorted = [...rows].sort((a, b) => sign * order(key(a, column), key(b, column)));
        body.append(...(next ? sorted : rows));
      };
      head.addEventListener("click", sort);
      head.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        sort();
      });
    });
  }

  // Text to take along.
  for (const pre of all(document, "pre")) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      getSelection().selectAllChildren(pre);
      try {
        await navigator.clipboard.writeText(pre.textContent);
      } catch {
        document.execCommand("copy");
      }
      getSelection().removeAllRanges();
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy"; }, 2000);
    });
    pre.before(button);
  }

  // A link to a folded place unfolds it.
  const unfold = () => {
    const place = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const details = place?.closest("details");
    if (details) details.open = true;
  };
  addEventListener("hashchange", unfold);
  unfold();
  document.documentElement.classList.add("scripted");
})();
