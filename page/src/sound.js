// Three short tones: for Good, for Bad, and for a goal.
import { state } from './state.js';

/** The pitches of each, one after the other. */
const TONES = { good: [660, 880], bad: [330, 247], goal: [523, 659, 784] };
const [APART, LENGTH, LOUDNESS] = [0.09, 0.16, 0.12];

/** @type {AudioContext | undefined} */
let audio;

/** Lets a tone be heard, if tones are switched on.
 * @param {keyof typeof TONES} what */
export function sound(what) {
  if (!state.settings.sound) return;
  audio ??= new AudioContext();
  // Browsers stop it until somebody has pressed something.
  audio.resume();
  for (const [at, pitch] of TONES[what].entries()) {
    const [tone, fading] = [audio.createOscillator(), audio.createGain()];
    const begin = audio.currentTime + at * APART;
    tone.frequency.value = pitch;
    fading.gain.setValueAtTime(LOUDNESS, begin);
    fading.gain.exponentialRampToValueAtTime(0.001, begin + LENGTH);
    tone.connect(fading).connect(audio.destination);
    tone.start(begin);
    tone.stop(begin + LENGTH);
  }
}
