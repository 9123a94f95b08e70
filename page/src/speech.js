// Spoken commands, where the browser can recognise speech, and what the robot says aloud, where somebody has switched that on.
import { $, announce, state, tell } from './state.js';

const SPEECH_ERRORS = { 'not-allowed': 'the microphone may not be used here', network: 'this browser needs a network for that', 'no-speech': 'nothing was said' };
/** @type {any} */
const browser = window;
const Recognition = browser.SpeechRecognition || browser.webkitSpeechRecognition;

/** Says a text aloud.
 * @param {string} text */
export function speak(text) {
  if (!state.settings.voice || !browser.speechSynthesis) return;
  browser.speechSynthesis.cancel();
  const utterance = new SpeechSynthesisUtterance(text);
  utterance.lang = document.documentElement.lang;
  browser.speechSynthesis.speak(utterance);
}

export function setUpSpeech() {
  const button = $('speak');
  $('set-voice').closest('label').hidden = !browser.speechSynthesis;
  if (!Recognition) return;
  button.hidden = false;
  button.addEventListener('click', () => {
    const recognition = new Recognition();
    recognition.lang = 'en';
    recognition.onresult = event => {
      $('command').value = event.results[0][0].transcript.toLowerCase();
      $('command').focus();
      announce('Heard: ' + $('command').value);
    };
    recognition.onerror = event => tell('Nothing was heard: ' + (SPEECH_ERRORS[event.error] || event.error) + '.', true);
    recognition.onend = () => button.setAttribute('aria-pressed', 'false');
    button.setAttribute('aria-pressed', 'true');
    recognition.start();
  });
}
