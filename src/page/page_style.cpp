// SPDX-License-Identifier: MIT
//
// Style sheet and script of a report page. The page is complete without the script, which adds
// values under the pointer and switches.
#include "page/page_html.hpp"

namespace stipple {

const char* page_style() {
    return R"CSS(
:root{color-scheme:light dark;--ground:#fff;--card:#fafafa;--ink:#1b1d21;--muted:#5d636d;
--line:#d5d8dd;--shade:#00000060;
--grid:#e9ebee;--band:#e4e6ea;--best:#e8f2ea;--star:#b3261e;--empty:#1a6b3c;--extreme:#6a3fa0;
--periodic:#8a5a00}
@media screen and (prefers-color-scheme:dark){:root{--ground:#16181c;--card:#1b1e23;
--ink:#e8eaed;--muted:#a3a9b3;
--line:#3a3f47;--shade:#ffffff60;--grid:#2a2e35;--band:#2f343c;--best:#1d3527;--star:#ff8a80;--empty:#6fcf97;
--extreme:#c3a2f5;
--periodic:#e0b050}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0 auto;padding:0 1.25rem 4rem;max-width:76rem;background:var(--ground);
color:var(--ink);
font:1rem/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",
Arial,"Liberation Sans",sans-serif}
header{padding:2rem 0 .75rem}
h1{margin:0;font-size:1.65rem;font-weight:650;letter-spacing:-.01em;line-height:1.2}
h2{margin:2.75rem 0 .25rem;font-size:1.3rem;font-weight:650;line-height:1.25;
overflow-wrap:anywhere}
h3{margin:1.75rem 0 .4rem;font-size:1rem;font-weight:650}
p{margin:.4rem 0}
.facts,figcaption,.note,.left-out,th small{color:var(--muted)}
.facts{font-size:.925rem;overflow-wrap:anywhere}
a{color:inherit}
nav{position:sticky;top:0;z-index:3;display:flex;flex-wrap:wrap;gap:.3rem 1.1rem;
margin:0 -1.25rem;padding:.6rem 1.25rem;
background:var(--ground);border-bottom:1px solid var(--line);font-size:.925rem;max-height:40vh;
overflow-y:auto}
nav label{display:inline-flex;align-items:center;gap:.4rem;cursor:pointer}
nav input{margin:0;accent-color:var(--c)}
nav a{text-decoration-color:var(--c);text-decoration-thickness:2px;text-underline-offset:.25em}
.swatch{display:inline-block;width:.7em;height:.7em;border-radius:50%;background:var(--c);
margin-right:.45em}
.scroll{overflow-x:auto;margin:.75rem 0;-webkit-overflow-scrolling:touch;
background:linear-gradient(to left,var(--ground) 30%,transparent) right/3rem 100% no-repeat local,
linear-gradient(to left,var(--shade),transparent) right/1.25rem 100% no-repeat scroll}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.925rem}
th,td{padding:.28rem .9rem .28rem 0;text-align:left;vertical-align:baseline;
border-bottom:1px solid var(--grid);white-space:nowrap}
td.number,th.number{text-align:right;padding-right:1.1rem;padding-left:.5rem}
thead th{border-bottom:1px solid var(--line);font-weight:600}
thead th.number{white-space:normal;min-width:6.5rem;max-width:11rem;overflow-wrap:anywhere}
#comparison th:first-child{position:sticky;left:0;z-index:1;background:var(--ground)}
#comparison tbody th{font-weight:400}
tr.group th{padding-top:.9rem;color:var(--muted);font-size:.8rem;font-weight:600;
letter-spacing:.04em;text-transform:uppercase}
td.best{font-weight:700;background:var(--best)}
td.best::after{content:"\00a0★";font-size:.75em;vertical-align:.1em}
td.none{color:var(--muted)}
.words{white-space:normal;min-width:9rem}
.verdict{display:inline-block;min-width:6.5em;font-weight:650}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,25rem),1fr));
gap:1.25rem 2.5rem;align-items:start}
.figures .wide{grid-column:1/-1}
figure{margin:.5rem 0;position:relative;min-width:0}
figcaption{font-size:.825rem;margin-top:.2rem}
svg{display:block;width:100%;height:auto;
font-family:Helvetica,Arial,"Liberation Sans","DejaVu Sans",sans-serif}
.picture svg{max-width:32rem}
.rule{stroke:var(--muted);stroke-width:1;visibility:hidden}
.box path{stroke:var(--b)}.box [fill-opacity]{fill:var(--b);stroke:none}
.star{--b:var(--star)}.empty{--b:var(--empty)}.extreme{--b:var(--extreme)}.periodic{
--b:var(--periodic)}
.boxes{list-style:none;margin:.4rem 0 0;padding:0;font-size:.85rem}
.boxes label{cursor:pointer}
.boxes input{margin:0 .3rem 0 0;vertical-align:-.1em}
.key{display:inline-block;width:1.1em;height:.75em;border:2px solid var(--b);margin-right:.3em}
.key.open{border-style:dashed}
@media screen and (prefers-color-scheme:dark){svg{isolation:isolate}
.inverted{filter:invert(1) hue-rotate(180deg);mix-blend-mode:screen}}
.tip{position:absolute;z-index:2;pointer-events:none;padding:.35rem .6rem;
border:1px solid var(--line);border-radius:.3rem;
background:var(--ground);font-size:.8rem;line-height:1.4;font-variant-numeric:tabular-nums;
white-space:nowrap}
.tip[hidden]{display:none}
.measures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,23rem),1fr));
gap:.25rem 2.5rem;align-items:start}
.measure{min-width:0}
.measure table{width:100%}
.measure td{white-space:normal;overflow-wrap:anywhere}
.measure th{font-weight:400;color:var(--muted)}.measure th,.measure td{padding-top:.15rem;
padding-bottom:.15rem}
pre{margin:.4rem 0;padding:.45rem .65rem;white-space:pre-wrap;overflow-wrap:anywhere;
border-radius:.3rem;background:var(--card);
border:1px solid var(--grid);
font:.8rem/1.45 ui-monospace,SFMono-Regular,Menlo,Consolas,"Liberation Mono",monospace}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1.2rem;font-size:.9rem}
dt{color:var(--muted)}dd{margin:0;overflow-wrap:anywhere}
summary{cursor:pointer}
footer{margin-top:3rem;padding-top:1rem;border-top:1px solid var(--line);font-size:.85rem;
color:var(--muted)}
@media (max-width:40rem){body{padding:0 .9rem 3rem}nav{margin:0 -.9rem;padding:.5rem .9rem}
header{padding-top:1.25rem}
th,td{padding-right:.7rem}table{font-size:.85rem}#comparison th:first-child{max-width:8.5rem;
white-space:normal}
td.number,th.number{padding-right:.25rem;padding-left:.25rem;white-space:normal}
thead th.number{min-width:0}
.chart svg text{font-size:15px}}
@media print{:root{color-scheme:light;--ground:#fff;--ink:#000;--muted:#444;--line:#bbb;
--grid:#ddd;--band:#e4e4e4}
body{max-width:none;padding:0;font-size:9.5pt}nav{position:static;margin:0;padding:.3rem 0;
max-height:none}nav input,.boxes input{display:none}
figure,.measure,tr,.verdicts{break-inside:avoid}h2,h3{break-after:avoid}
section.set{break-before:page}.scroll{overflow:visible;background:none}
.swatch,.key,td.best{print-color-adjust:exact;-webkit-print-color-adjust:exact}
.boxes li:has(input:not(:checked)){display:none}
.figures{grid-template-columns:1fr 1fr}.picture svg{max-width:100%}#comparison{
font-size:8pt}
th,td{white-space:normal;padding-right:.5rem}}
)CSS";
}

const char* page_script() {
    return R"JS(
(() => {
  'use strict';
  const body = document.body;
  for (const box of document.querySelectorAll('nav input')) {
    box.addEventListener('change', () => body.classList.toggle('hide-' + box.value, !box.checked));
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
      const x = data.from + (at - data.left) / (data.right - data.left) * (data.to - data.from);
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
      const share = (shown - data.from) / (data.to - data.from);
      const place = data.left + share * (data.right - data.left);
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
  addEventListener('beforeprint', () => {
    for (const part of document.querySelectorAll('details')) part.open = true;
  });
  document.documentElement.dataset.ready = 'yes';
})();
)JS";
}

}  // namespace stipple
