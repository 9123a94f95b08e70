// The strategies that the robot expects of its trainer: those of real people, one of the paper's, or numbers, as in `goodbot replay
// --believes`.
import { world } from './core.js';
import { t } from './language.js';

const PEOPLE = 'population';
// The probability of silence after a right step, of silence after a wrong one, and of taking one for the other.
const NAMED = { balanced: '0.7,0.7,0.1', 'punish-only': '0.7,0.05,0.1', 'reward-only': '0.05,0.7,0.1' };

export const CHOICES = [PEOPLE, ...Object.keys(NAMED), 'own'];

// A word is meant for the last step.
export const NO_LAG = [1, 0, 0];

// The numbers of a strategy: three and the prior, three lags, four about rests.
const NUMBERS = 11;

/** The numbers about rests of a trainer who judges rests like moves, as in the robot's core. */
export const restsAsMoves = (plus, minus, mistakes) => [plus, minus, mistakes, 0];

/** The strategies that the robot expected before it met its trainer: a name, or numbers. */
export function expectedNow() {
  const numbers = [...world.strategies()].map(number => Number(number.toFixed(6)));
  const strategies = Array.from({ length: numbers.length / NUMBERS }, (_, at) => {
    const [plus, minus, mistakes, weight, ...more] = numbers.slice(NUMBERS * at, NUMBERS * (at + 1));
    const [lags, rests] = [more.slice(0, NO_LAG.length), more.slice(NO_LAG.length)];
    const asMoves = rests.join() === restsAsMoves(plus, minus, mistakes).join();
    const text = [plus, minus, mistakes, ...(lags[0] === 1 && asMoves ? [] : lags), ...(asMoves ? [] : rests)].join();
    const name = Object.entries(NAMED).find(([, named]) => named === text)?.[0] || text;
    return numbers.length > NUMBERS ? name + '*' + weight : name;
  });
  return strategies.join('; ') || PEOPLE;
}

const number = text => (text.trim() ? Number(text) : NaN);

/** Makes the robot expect these strategies: a name, or three, six or ten numbers; or several of them with semicolons between, each with its weight after a
 * star. Throws if the text is none of that.
 * @param {string} text */
export function expectTrainer(text) {
  const strategies = text.trim() === PEOPLE ? [] : text.split(';').flatMap(one => {
    const [what, weight = '1'] = one.split('*');
    const [plus, minus, mistakes, ...more] = (NAMED[what.trim()] || what).split(',').map(number);
    if (mistakes === undefined || ![0, 3, 7].includes(more.length)) throw new Error(t('believes.form'));
    const all = [...(more.length ? more : NO_LAG), ...(more.length === 7 ? [] : restsAsMoves(plus, minus, mistakes))];
    return [plus, minus, mistakes, number(weight), ...all];
  });
  world.setStrategies(Float32Array.from(strategies));
}
