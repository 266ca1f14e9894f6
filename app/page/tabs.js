// Tabs as in the ARIA practices: one is in the tab order, arrow keys go from one to the next and show it at once.

export class Tabs {
  #tabs; #onShow;

  // `onShow` hears the name of the view that is shown: the panel of `tab-map` is `view-map`.
  constructor(list, onShow) {
    this.#tabs = [...list.querySelectorAll("[role=tab]")];
    this.#onShow = onShow;
    list.addEventListener("click", ({ target }) => { const tab = target.closest("[role=tab]"); if (tab) this.show(nameOf(tab)); });
    list.addEventListener("keydown", (event) => this.#press(event));
  }

  get shown() { return nameOf(this.#tabs.find((tab) => tab.ariaSelected === "true")); }

  show(name) {
    for (const tab of this.#tabs) {
      const isShown = nameOf(tab) === name;
      tab.ariaSelected = String(isShown);
      tab.tabIndex = isShown ? 0 : -1;
      if (isShown) { tab.hidden = false; tab.scrollIntoView({ block: "nearest", inline: "nearest" }); }
      document.getElementById(tab.getAttribute("aria-controls")).hidden = !isShown;
    }
    this.#onShow(name);
  }

  #press(event) {
    const open = this.#tabs.filter((tab) => !tab.hidden), at = open.indexOf(document.activeElement);
    const next = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: -1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    const tab = open.at(next % open.length);
    tab.focus();
    this.show(nameOf(tab));
  }
}

const nameOf = (tab) => tab.id.replace("tab-", "");
