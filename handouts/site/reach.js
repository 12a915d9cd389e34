// What the theme makes when a page has loaded, for those who use keys or a screen reader: tables that
// are wider than the window can be reached and moved, and each bar above code has a name of its own.

function mend() {
  for (const wide of document.querySelectorAll(".md-typeset__scrollwrap:not([tabindex])")) {
    wide.tabIndex = 0;
  }
  document.querySelectorAll("nav.md-code__nav:not([aria-label])").forEach((bar) => {
    bar.ariaLabel = `for code ${[...document.querySelectorAll("nav.md-code__nav")].indexOf(bar) + 1}`;
  });
}

new MutationObserver(mend).observe(document.documentElement, { childList: true, subtree: true });
addEventListener("load", mend);
