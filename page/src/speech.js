// Spoken commands, where the browser can recognise speech.
const Recognition = window.SpeechRecognition || window.webkitSpeechRecognition;

function setUpSpeech() {
  const button = $('speak');
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
    recognition.onerror = event => tell('The browser heard nothing it could write down (' + event.error + ').', true);
    recognition.onend = () => button.setAttribute('aria-pressed', 'false');
    button.setAttribute('aria-pressed', 'true');
    recognition.start();
  });
}
