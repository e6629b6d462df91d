// What JupyterLab lacks for the course. A prebuilt extension, written by hand: it needs no package of JupyterLab.

const PANEL = "Robot"; // the title that lab/pictures/panel.py gives to it
const NARROW = 1500; // px; in a narrower window lines of code fit beside the panel only without the file browser
const OPEN_TIMEOUT = 120; // s, for a chapter on a busy machine
const LAYOUT_TIMEOUT = 30; // s, from the time at which its heading is there
const STEADY = 25; // times that a heading was seen at the same place; JupyterLab may still scroll back to the first cell
const PERIOD = 200; // ms

const SIDEWAYS = ["ArrowLeft", "ArrowRight"];
const NO_CHOICE = "Predict first"; // how lab/learning/prediction.py answers a reply() without a choice
const ARROWS = ["ArrowUp", "ArrowDown", ...SIDEWAYS];
const BACK = ["ArrowUp", "ArrowLeft"];
const COPIED = ["kernelspec", "language_info"]; // metadata
const NAMELESS = ".widget-radio-box input[type=radio]:not([name])";
const OUTPUT = ".jp-OutputArea-output:not([tabindex])";
const WIDE = `:is(${OUTPUT}, ${OUTPUT} > details) > svg.course-drawing`;
const REPLY = /^prediction_\d+\.reply\(\)/m; // the cell after an experiment
const NO_MAGIC = /^UsageError: Cell magic `%%gap` not found/;
const NEW_SECTION = /^## /;
const NEW_TASK = /^(#+ |%%)/; // a heading, or a program to write

let groups = 0; // of radio buttons, so far
let hasPanel = false;
let isFolded = false; // the file browser, for the panel

const pause = () => new Promise((resolve) => setTimeout(resolve, PERIOD));

// A notebook that is opened again shows its panel again, beside the one of its closed tab.
function keepNewestPanel(shell) {
  const panels = [...shell.widgets("right")].filter((widget) => widget.title.label === PANEL);
  panels.slice(0, -1).forEach((panel) => panel.dispose());
  if (panels.length && !hasPanel && window.innerWidth < NARROW && !shell.leftCollapsed) {
    shell.collapseLeft();
    isFolded = true;
  } else if (!panels.length && isFolded) {
    shell.expandLeft();
    isFolded = false;
  }
  hasPanel = panels.length > 0;
}

// What unfolds below the edge of the page, such as a film of a failed check, comes into view.
function showUnfolded({ target }) {
  if (target.open && target.closest(".jp-OutputArea-output")) target.scrollIntoView({ block: "nearest" });
}

// ipywidgets gives radio buttons no name, and the browser takes all buttons without a name for one group: an arrow key
// would leave a question and change the answer to another.
function nameGroups() {
  for (const radio of document.querySelectorAll(NAMELESS)) {
    const group = radio.closest(".widget-radio-box");
    group.id ||= `course-question-${++groups}`;
    group.role = "radiogroup";
    group.ariaLabel = radio.closest(".jp-OutputArea")?.querySelector("p")?.textContent ?? "answers";
    radio.name = group.id;
  }
}

// Keys reach a drawing that is wider than the page and scrolls (custom.css).
function letDrawingsScroll() {
  for (const drawing of document.querySelectorAll(WIDE)) {
    const output = drawing.closest(".jp-OutputArea-output");
    output.tabIndex = 0;
    output.role = "group";
    output.ariaLabel = drawing.querySelector("title")?.textContent ?? "drawing";
  }
}

// An arrow key goes to another answer of a question without choosing it, because a chosen answer is marked at once.
function goToAnswer(key, radio) {
  const answers = [...radio.closest(".widget-radio-box").querySelectorAll("input[type=radio]")];
  const step = BACK.includes(key) ? -1 : 1;
  answers.at((answers.indexOf(radio) + step) % answers.length).focus();
}

// JupyterLab would go to the next cell on an arrow key. Esc leads back to the cell.
function keepKeys(event, shell) {
  const { key, target } = event;
  const isIn = (place) => target.matches?.(place);
  if (ARROWS.includes(key) && isIn(".widget-radio-box input[type=radio]")) {
    event.stopPropagation();
    event.preventDefault();
    goToAnswer(key, target);
  }
  if (SIDEWAYS.includes(key) && isIn(".jp-OutputArea-output[tabindex]")) event.stopPropagation();
  if (key === "Escape" && isIn(".jp-OutputArea *")) shell.currentWidget?.content?.activeCell?.node.focus();
}

// The texts of a section below a prediction's reply tell the outcome; they appear when the reply has run, and so have the
// cells between the reply and the text (custom.css hides them).
function hideOutcomes(notebook) {
  let [isAwaited, isNear, isSkipped] = [false, false, false];
  for (const cell of notebook.widgets) {
    const { executionCount, outputs, sharedModel, type } = cell.model;
    if (REPLY.test(sharedModel.source)) {
      isAwaited = !outputs?.length || JSON.stringify(outputs.toJSON()).includes(NO_CHOICE);
      [isNear, isSkipped] = [true, false];
    } else if (NEW_TASK.test(sharedModel.source)) {
      isAwaited &&= !NEW_SECTION.test(sharedModel.source);
      isNear = isSkipped = false;
    } else if (isNear && type === "code") isSkipped ||= !executionCount;
    cell.toggleClass("course-outcome", (isAwaited || isSkipped) && type === "markdown");
  }
}

// After a restart of the kernel a cell may lack what the cells above define (custom.css says so).
function nameUnrunCells(notebook) {
  let highest = 0; // execution count of the cells above; those that have not run count as run later
  for (const cell of notebook.widgets.filter(({ model }) => model.type === "code")) {
    const { executionCount, outputs } = cell.model;
    const lacksName = outputs.toJSON().some(({ ename, text }) => ename === "NameError" || NO_MAGIC.test(text));
    cell.toggleClass("course-unrun", lacksName && highest >= executionCount);
    highest = Math.max(highest, executionCount ?? Infinity);
  }
}

// What JupyterLab copies from the kernel into a notebook is no change that its reader has to save.
async function keepClean({ model, ready }) {
  await ready; // until then the notebook is read
  model.metadataChanged.connect((_, { key }) => {
    const before = model.dirty;
    if (COPIED.includes(key)) queueMicrotask(() => (model.dirty = before)); // it becomes dirty after this signal
  });
}

// The keys act on the selected cell, which is elsewhere when a link has scrolled to a heading.
function select(notebook, heading) {
  const index = notebook?.widgets.findIndex(({ node }) => node.contains(heading)) ?? -1;
  if (index >= 0 && index !== notebook.activeCellIndex) {
    notebook.mode = "command";
    notebook.deselectAll();
    notebook.activeCellIndex = index;
  }
}

// JupyterLab scrolls as soon as a notebook is read, when its cells have no height yet.
async function land(shell, path, fragment) {
  const input = new AbortController();
  const { signal } = input;
  for (const kind of ["wheel", "keydown", "pointerdown"]) {
    document.addEventListener(kind, () => input.abort(), { capture: true, signal });
  }
  const id = CSS.escape(decodeURIComponent(fragment.slice(1)));
  let end = Date.now() + 1000 * OPEN_TIMEOUT;
  for (let seen = 0, place; seen < STEADY && Date.now() < end && !signal.aborted; await pause()) {
    const notebook = [...shell.widgets("main")].find((widget) => widget.context?.path === path);
    const heading = notebook?.node.querySelector(`[id="${id}"], [data-jupyter-id="${id}"]`);
    if (heading && place === undefined) end = Date.now() + 1000 * LAYOUT_TIMEOUT;
    const { top, height } = heading?.getBoundingClientRect() ?? {};
    seen = height && top === place ? seen + 1 : 0; // without height while the notebook is hidden
    heading?.scrollIntoView();
    select(notebook?.content, heading);
    place = heading?.getBoundingClientRect().top;
  }
  input.abort();
}

const plugin = {
  id: "humanoid-course:desk",
  autoStart: true,
  activate: ({ commands, docRegistry, shell }) => {
    const early = { capture: true }; // before JupyterLab, which listens at the document
    window.addEventListener("keydown", (event) => keepKeys(event, shell), early);
    document.addEventListener("toggle", showUnfolded, early); // a toggle does not bubble
    const added = new MutationObserver(() => {
      nameGroups();
      letDrawingsScroll();
    });
    added.observe(document.body, { childList: true, subtree: true });
    docRegistry.addWidgetExtension("Notebook", {
      createNew: ({ content }, context) => {
        keepClean(context);
        const update = () => [hideOutcomes, nameUnrunCells].forEach((mark) => mark(content));
        content.modelContentChanged.connect(update);
        context.ready.then(update);
      },
    });
    shell.layoutModified.connect(keepNewestPanel);
    commands.commandExecuted.connect((_, { id, args }) => {
      if (id === "rendermime:handle-local-link" && args.id) land(shell, args.path, args.id);
    });
  },
};

(window._JUPYTERLAB ??= {})["humanoid-course"] = { init: () => {}, get: async () => () => plugin };
