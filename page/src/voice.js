// Spoken commands, if the browser recognises speech, and a robot that speaks, if that is switched on.
import { named, t } from './language.js';
import { $, announce, state, tell } from './state.js';

/** @type {any} */
const browser = window;
const Recognition = browser.SpeechRecognition || browser.webkitSpeechRecognition;

/** Whether commands can be spoken: a teacher may not want that a voice leaves the room. */
export const maySpeak = () => Boolean(Recognition) && state.settings.speech;

let spoken = '';

/** Says a text aloud, unless it was the last one.
 * @param {string} text */
export function speak(text) {
  const isNew = text !== spoken;
  spoken = text;
  if (!isNew || !text || !state.settings.voice || !browser.speechSynthesis) return;
  browser.speechSynthesis.cancel();
  const utterance = new SpeechSynthesisUtterance(text);
  utterance.lang = document.documentElement.lang;
  browser.speechSynthesis.speak(utterance);
}

export function setUpSpeech() {
  const button = $('speak');
  $('set-voice').closest('label').hidden = !browser.speechSynthesis;
  $('set-speech').closest('label').hidden = !Recognition;
  if (!Recognition) return;
  button.addEventListener('click', () => {
    const recognition = new Recognition();
    recognition.lang = document.documentElement.lang;
    recognition.onresult = event => {
      $('command').value = event.results[0][0].transcript.toLowerCase();
      $('command').focus();
      announce(t('speech.heard', { text: $('command').value }));
    };
    recognition.onerror = event => tell(t('speech.nothing', { why: named('speech.' + event.error) || event.error }), true);
    recognition.onend = () => button.setAttribute('aria-pressed', 'false');
    button.setAttribute('aria-pressed', 'true');
    recognition.start();
  });
}
