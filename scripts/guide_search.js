// SPDX-License-Identifier: MIT
// Search of the guide's site, without a server: `pages` holds the text of all sections.
"use strict";

const index = lunr(function () {
  this.ref("number");
  this.field("title", {boost: 10});
  this.field("text");
  this.pipeline.remove(lunr.stopWordFilter);
  pages.forEach((page, number) => this.add({number, title: page.title, text: page.text}));
});

function found(query) {
  const words = lunr.tokenizer(query).map(String);
  return index.query((q) => words.forEach((word) => {
    q.term(index.pipeline.runString(word), {boost: 10});
    q.term(word, {wildcard: lunr.Query.wildcard.TRAILING});
  }));
}

/// The text about the first place of a word.
function excerpt(text, query) {
  const word = query.trim().split(/\s+/)[0].toLowerCase();
  const at = Math.max(0, text.toLowerCase().indexOf(word) - 60);
  return (at > 0 ? "… " : "") + text.slice(at, at + 240) + (text.length > at + 240 ? " …" : "");
}

function show(results, query) {
  const place = document.getElementById("mkdocs-search-results");
  place.replaceChildren();
  if (results.length === 0) place.textContent = "Nothing found.";
  for (const result of results.slice(0, 50)) {
    const page = pages[Number(result.ref)];
    const link = document.createElement("a");
    link.href = (base_url === "." ? "" : base_url + "/") + page.location;
    link.textContent = page.title;
    const heading = document.createElement("h3");
    heading.append(link);
    const text = document.createElement("p");
    text.textContent = excerpt(page.text, query);
    place.append(heading, text);
  }
}

const input = document.getElementById("mkdocs-search-query");
if (input && document.getElementById("mkdocs-search-results")) {
  const search = () => show(input.value.trim().length > 1 ? found(input.value) : [], input.value);
  input.addEventListener("input", search);
  const asked = new URLSearchParams(window.location.search).get("q");
  if (asked) {
    input.value = asked;
    search();
  }
}
