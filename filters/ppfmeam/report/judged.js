// SPDX-License-Identifier: BSD-3-Clause
// Shows the page of the image that the address names, #image3, or of the first one.
"use strict";
(() => {
  const read = id => JSON.parse(document.getElementById(id).textContent);
  const shared = read("shared"), links = Array.from(document.querySelectorAll("td a"));
  function open() {
    const link = links.find(each => each.hash === location.hash) || links[0];
    if (!link) return;
    document.querySelectorAll("tr").forEach(row => row.classList.toggle("chosen", row.contains(link)));
    const slots = read(link.hash.slice(1));
    slots.DATA = JSON.stringify({ ...slots.DATA, parts: shared.parts }).replace(/</g, "\\u003c");
    document.querySelector("iframe").srcdoc = shared.page.replace(/@([A-Z]+)@/g, (whole, name) => name in slots ? slots[name] : whole);
  }
  window.addEventListener("hashchange", open);
  open();
})();
