// The beginning, and the one place from which everything is drawn.
let Core = null;

function render() {
  const session = state.session;
  const focused = document.activeElement;
  const busy = state.phase === 'learning';
  document.body.dataset.mode = state.mode;
  document.body.dataset.phase = state.phase;
  document.body.toggleAttribute('data-session', Boolean(session));
  for (const button of document.querySelectorAll('button[data-mode]')) button.setAttribute('aria-pressed', button.dataset.mode === state.mode);
  renderPlan();
  renderTour();
  renderBuild();
  renderThoughts();
  renderSettings();
  const [head, rest] = speech();
  $('say').replaceChildren(make('strong', {}, head), ' ', make('span', {}, rest));
  $('tell').hidden = state.mode === 'build' || state.mode === 'tour';
  $('train').hidden = state.mode === 'build';
  $('plan').parentElement.hidden = state.mode === 'build';
  $('command').readOnly = Boolean(session);
  $('say-it').disabled = Boolean(session) || busy;
  const active = session && session.decided && state.phase !== 'planning' && !busy && !session.looking;
  for (const id of ['good', 'bad']) {
    $(id).setAttribute('aria-disabled', !active);
    const given = Boolean(session && session.feedback === (id === 'good' ? 'reward' : 'punish'));
    $(id).setAttribute('aria-pressed', given);
    $(id).querySelector('small').textContent = given ? acted(session.decided.action).split(' where')[0] : '';
  }
  $('to').textContent = !session || !session.decided ? 'Your word goes to the robot’s last step.' : session.looking ? 'A test: no feedback.'
    : 'It ' + acted(session.decided.action) + '. ' + ({ reward: 'You said Good.', punish: 'You said Bad.' }[session.feedback] || 'Good or Bad?');
  $('pause').textContent = session && session.paused ? 'Go on' : 'Pause';
  $('pause').disabled = $('next').disabled = !session || busy;
  for (const id of ['pause', 'next']) $(id).hidden = !session;
  for (const id of ['finish', 'drop']) $(id).hidden = !session || session.looking;
  $('finish').disabled = $('drop').disabled = !session || busy || Boolean(session && session.looking);
  $('undo').hidden = !state.undo || Boolean(session) || busy;
  for (const element of document.querySelectorAll('.place')) element.hidden = Boolean(session);
  $('choose').hidden = $('home').value !== 'random' || Boolean(session);
  renderIdeas();
  const wait = $('wait');
  wait.style.animation = 'none';
  if (session && state.phase === 'waiting' && session.delay > 300 && session.delay < Infinity && !session.paused) {
    void wait.offsetWidth;
    wait.style.animation = 'fill ' + session.delay + 'ms linear ' + (session.since - performance.now()) + 'ms both';
  }
  // Who works by keyboard is not left on a button that has gone.
  if (focused && focused !== document.body && (focused.disabled || focused.closest('[hidden]'))) (session ? $('good') : $('lesson').offsetParent ? $('lesson') : $('command').offsetParent ? $('command') : $('main')).focus({ preventScroll: true });
}

// Commands that make sense here, for those who do not know what to say.
function renderIdeas() {
  const { rooms, blocks } = state.scene;
  const room = rooms[(blocks.length + 1) % rooms.length];
  const ideas = ['go to the ' + rooms[0].color + ' room', ...blocks.slice(0, 1).map(block => 'take the ' + block.color + ' ' + block.shape + ' to the ' + room.color + ' room'), 'go to the ' + rooms[rooms.length - 1].color + ' room'];
  $('ideas').hidden = Boolean(state.session);
  if ($('ideas').dataset.key === ideas.join()) return;
  $('ideas').dataset.key = ideas.join();
  $('ideas').replaceChildren(...ideas.map(idea => make('button', {
    type: 'button', class: 'idea', onclick: () => { $('command').value = idea; $('say-it').focus(); },
  }, idea)));
}

function setMode(mode) {
  if (mode === state.mode) return;
  stopSession();
  state.tour.watching = false;
  state.mode = mode;
  if (mode === 'build') enterBuild();
  else if (mode === 'tour') enterStop(state.tour.at);
  else {
    enterHome(world.environment());
    nameHome();
    render();
  }
}

// Which of the homes on the list this is.
function nameHome() {
  const home = world.environment();
  const known = course.homes.find(([, other]) => JSON.stringify(other) === home);
  $('home').value = known ? known[0] : home === kept(KEYS.own) ? 'own' : 'random';
}

function setUpPlay() {
  for (const [name] of course.homes) $('home').append(make('option', { value: name }, name === 'Test' ? 'The tests’ home' : 'Home ' + name + ' of the course'));
  $('home').append(make('option', { value: 'random' }, 'Another, at random'), make('option', { value: 'own' }, 'Your own'));
  const choose = () => {
    const { value } = $('home');
    if (value === 'own') {
      const own = kept(KEYS.own);
      if (own) enterHome(own);
      else setMode('build');
    } else if (value === 'random') {
      const { homes } = parsed(Core.course(1 + Math.floor(Math.random() * 4e9)));
      enterHome(JSON.stringify(homes[Math.floor(Math.random() * homes.length)][1]));
    } else enterHome(homeNamed(value));
    render();
  };
  $('home').addEventListener('change', choose);
  $('choose').addEventListener('click', choose);
  $('tell').addEventListener('submit', event => {
    event.preventDefault();
    if (!state.session) startSession($('command').value);
  });
  $('reset').addEventListener('click', () => { stopSession(); world.reset(); refresh(); render(); });
}

function setUp() {
  $('logo').append(...robotDrawing());
  setUpPlay();
  setUpSettings();
  setUpShortcuts();
  setUpSpeech();
  setUpBuild();
  for (const button of document.querySelectorAll('button[data-mode]')) button.addEventListener('click', () => setMode(button.dataset.mode));
  for (const [id, action] of Object.entries({
    good: () => giveFeedback('reward'), bad: () => giveFeedback('punish'), pause: togglePause, next: stepOnce, finish: finishSession,
    drop: finishWithoutLearning, undo: undoSession, lesson: () => beginStop(false), auto: () => beginStop(true), watch: watchTour, again: restartTour,
    onward: () => setMode('play'),
  })) $(id).addEventListener('click', action);
  $('heat-before').addEventListener('change', renderHeat);
  $('heat').closest('details').addEventListener('toggle', renderHeat);
  window.addEventListener('hashchange', () => {
    if (readHash()) {
      stopSession();
      state.mode = 'play';
      refresh();
      render();
    }
  });
}

async function main() {
  core.initSync({ module: unpack(fromBase64($('module').textContent.trim()), Number($('module').dataset.size)) });
  Core = core.Goodbot;
  world = new Core(2014);
  // For the curious, at the browser's console, and for tests.
  window.goodbot = world;
  course = parsed(Core.course(0));
  await restoreAll();
  const own = kept(KEYS.home);
  if (own) attempt(() => world.setEnvironment(own));
  if (readHash()) state.mode = 'play';
  if (state.settings.style !== world.learnsStyle()) attempt(() => world.setLearnsStyle(state.settings.style));
  state.heat = { now: heatNow(), before: null };
  refresh();
  setUp();
  if (state.mode === 'tour') enterStop(state.tour.at);
  else nameHome();
  render();
  document.body.classList.add('ready');
}

main().catch(error => {
  $('say').textContent = 'This browser cannot run the robot: ' + error.message;
});
