// <goodbot-trainer>: the trainer page in any site. The page is a document of its own: its styles and the site's do not mix.
const PAGE = new URL('./goodbot.html', import.meta.url).href;

class GoodbotTrainer extends HTMLElement {
  static observedAttributes = ['src', 'language'];
  #frame;
  #observer;
  #told = { sessions: -1, belief: '' };
  #log = '';

  connectedCallback() {
    this.style.display ||= 'block';
    this.style.minHeight ||= '568px';
    const root = this.shadowRoot ?? this.attachShadow({ mode: 'open' });
    this.#frame = document.createElement('iframe');
    Object.assign(this.#frame, { src: this.getAttribute('src') ?? PAGE, title: 'goodbot' });
    this.#frame.style.cssText = 'display:block;width:100%;height:100%;min-height:inherit;border:0';
    this.#frame.addEventListener('load', () => this.#watch());
    root.replaceChildren(this.#frame);
  }

  disconnectedCallback() {
    this.#observer?.disconnect();
    this.#frame = this.#observer = undefined;
    this.#told = { sessions: -1, belief: '' };
  }

  attributeChangedCallback(name, before, now) {
    if (!this.#frame || before === now) return;
    if (name === 'src') this.#frame.src = now ?? PAGE;
    else this.#speak();
  }

  /** The robot in the page, as the module's types describe it; undefined until the event `goodbot-ready`. */
  get robot() { return this.#inside?.defaultView?.goodbot; }

  /** The robot's model, as bytes for `Goodbot.restore`, a file, or another shell. */
  get model() { return this.robot?.save(); }

  // Null if the page comes from another site.
  get #inside() { return this.#frame?.contentDocument; }

  #watch() {
    this.#observer?.disconnect();
    const inside = this.#inside;
    if (!inside) {
      return this.#tell('goodbot-error', { reason: 'the page comes from another site: copy goodbot.html of the package to yours, and name it by the attribute src' });
    }
    let isAsked = false;
    this.#observer = new MutationObserver(() => {
      if (isAsked) return;
      isAsked = true;
      // Once for all changes in a frame.
      inside.defaultView?.requestAnimationFrame(() => {
        isAsked = false;
        this.#compare();
      });
    });
    this.#observer.observe(inside, { subtree: true, childList: true, attributes: true, attributeFilter: ['class', 'data-phase'] });
    this.#compare();
  }

  #compare() {
    const robot = this.#inside?.body?.classList.contains('ready') && this.robot;
    if (!robot) return;
    const [before, sessions, belief] = [this.#told, robot.sessions(), robot.belief()];
    // There is a log while a session is under way.
    try { this.#log = robot.log(); } catch { /* None is. */ }
    // Set first: a listener may train the robot.
    this.#told = { sessions, belief };
    if (before.sessions < 0) {
      this.#speak();
      this.#tell('goodbot-ready', { sessions });
    } else if (sessions !== before.sessions) {
      this.#tell('goodbot-session', { sessions, log: this.#log });
    }
    if (belief !== before.belief) this.#tell('goodbot-belief', JSON.parse(belief));
  }

  #speak() {
    const [code, choice] = [this.getAttribute('language'), this.#inside?.getElementById('language')];
    if (!code || !choice || choice.value === code) return;
    choice.value = code;
    choice.dispatchEvent(new Event('change'));
  }

  #tell(name, detail) { this.dispatchEvent(new CustomEvent(name, { detail, bubbles: true, composed: true })); }
}

if (!customElements.get('goodbot-trainer')) customElements.define('goodbot-trainer', GoodbotTrainer);
export { GoodbotTrainer };
