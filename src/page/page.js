(() => {
  'use strict';
  const body = document.body;
  // As best_of() of content.cpp does, among the sets that are shown.
  const heads = document.querySelectorAll('#comparison thead th[data-set]');
  const isShown = element => !body.classList.contains('hide-' + element.dataset.set);
  const mark = row => {
    const alike = name => new Set([...heads].filter(isShown).map(head => head.dataset[name])).size < 2;
    const fair = alike('domain') && ('anyCount' in row.dataset || alike('count'));
    const noWorse = (a, b) => row.dataset.better === 'lower' ? +a.high <= +b.low : +a.low >= +b.high;
    const cells = [...row.querySelectorAll('td[data-low]')];
    const known = cells.filter(isShown);
    const best = known.filter(a => fair && known.every(b => a === b || noWorse(a.dataset, b.dataset)));
    for (const cell of cells) {
      const isBest = known.length > 1 && best.length < known.length && best.includes(cell);
      cell.classList.toggle('best', isBest);
      cell.title = cell.title.split(', ')[0] + (isBest ? ', best of these' : '');
    }
  };
  for (const box of document.querySelectorAll('nav input')) {
    box.addEventListener('change', () => {
      body.classList.toggle('hide-' + box.value, !box.checked);
      document.querySelectorAll('tr[data-better]').forEach(mark);
    });
  }
  const show = (figure, box) => {
    for (const group of figure.querySelectorAll('g.box.' + box.dataset.box)) {
      group.style.display = box.checked ? '' : 'none';
    }
  };
  for (const figure of document.querySelectorAll('figure')) {
    for (const box of figure.querySelectorAll('input[data-box]')) {
      show(figure, box);
      box.addEventListener('change', () => show(figure, box));
    }
  }
  const nearest = (xs, x) => {
    let low = 0, high = xs.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (xs[middle] > x) high = middle; else low = middle;
    }
    return x - xs[low] < xs[high] - x ? low : high;
  };
  const text = (parent, words, colour) => {
    const line = document.createElement('div');
    if (colour) {
      const swatch = document.createElement('span');
      swatch.className = 'swatch';
      swatch.style.setProperty('--c', colour);
      line.append(swatch);
    }
    line.append(words);
    parent.append(line);
  };
  for (const figure of document.querySelectorAll('figure.chart')) {
    const data = JSON.parse(figure.querySelector('script').textContent);
    const svg = figure.querySelector('svg');
    const tip = figure.querySelector('.tip');
    const rule = document.createElementNS(svg.namespaceURI, 'path');
    rule.setAttribute('class', 'rule');
    rule.setAttribute('d', 'M0 ' + data.top + 'V' + data.bottom);
    svg.append(rule);
    const hide = () => { tip.hidden = true; rule.style.visibility = 'hidden'; };
    const move = event => {
      const box = svg.getBoundingClientRect();
      const at = (event.clientX - box.left) / box.width * data.width;
      const share = (at - data.left) / (data.right - data.left);
      const x = data.log ? data.from * (data.to / data.from) ** share
                         : data.from + share * (data.to - data.from);
      const seen = data.curves.filter(c => !body.classList.contains('hide-' + c.set));
      if (at < data.left || at > data.right || !seen.length) return hide();
      tip.replaceChildren();
      let shown = null;
      for (const curve of seen) {
        const i = nearest(curve.x, x);
        if (shown === null) {
          shown = curve.x[i];
          text(tip, data.x + ' ' + shown);
        }
        const y = curve.y[i] === null ? '–' : String(curve.y[i]);
        text(tip, (curve.x[i] === shown ? y : y + ' at ' + curve.x[i]) + '  ' + curve.name,
             'var(--c' + curve.set + ')');
      }
      const part = data.log ? Math.log(shown / data.from) / Math.log(data.to / data.from)
                            : (shown - data.from) / (data.to - data.from);
      const place = data.left + part * (data.right - data.left);
      rule.setAttribute('transform', 'translate(' + place + ' 0)');
      rule.style.visibility = 'visible';
      tip.hidden = false;
      const room = figure.clientWidth - tip.offsetWidth;
      tip.style.left = Math.max(0, Math.min(room, event.clientX - box.left + 14)) + 'px';
      tip.style.top = Math.max(0, event.clientY - box.top - tip.offsetHeight - 10) + 'px';
    };
    svg.addEventListener('pointermove', move);
    svg.addEventListener('pointerdown', move);
    svg.addEventListener('pointerleave', hide);
  }
  // A picture as it looks, as a file of its own.
  const inherited = ['fill', 'fill-opacity', 'stroke', 'stroke-width', 'stroke-dasharray', 'font-family',
    'font-size', 'font-weight', 'text-anchor'];
  const saved = svg => {
    const copy = svg.cloneNode(true);
    const from = [svg, ...svg.querySelectorAll('*')];
    [copy, ...copy.querySelectorAll('*')].forEach((element, i) => {
      const looks = getComputedStyle(from[i]);
      const above = i > 0 ? getComputedStyle(from[i].parentNode) : null;
      element.removeAttribute('style');
      for (const name of inherited) {
        const value = looks.getPropertyValue(name);
        const plain = above ? value === above.getPropertyValue(name) : false;
        if (!plain) element.style.setProperty(name, value);
      }
      if (looks.display === 'none' || looks.filter !== 'none') {
        element.style.display = looks.display;
        element.style.filter = looks.filter;
      }
    });
    copy.querySelectorAll('.rule').forEach(rule => rule.remove());
    copy.style.background = getComputedStyle(body).backgroundColor;
    const [, , width, height] = svg.getAttribute('viewBox').split(' ');
    copy.setAttribute('width', width);
    copy.setAttribute('height', height);
    return new XMLSerializer().serializeToString(copy);
  };
  for (const figure of document.querySelectorAll('figure')) {
    const svg = figure.querySelector('svg');
    if (!svg) continue;
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'save';
    button.textContent = 'Save as SVG';
    button.addEventListener('click', () => {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(new Blob([saved(svg)], {type: 'image/svg+xml'}));
      link.download = (svg.getAttribute('aria-label') || 'picture').replace(/[^\w.-]+/g, '-') + '.svg';
      link.click();
      URL.revokeObjectURL(link.href);
    });
    figure.prepend(button);
  }
  addEventListener('beforeprint', () => {
    for (const part of document.querySelectorAll('details')) part.open = true;
  });
  document.documentElement.dataset.ready = 'yes';
})();
