// What the robot expects of its trainer: what real people do, one of the paper's strategies, or numbers, as `goodbot replay --believes` has them.
import { world } from './core.js';
import { t } from './language.js';

const PEOPLE = 'population';
// How probable silence is after a right step, and after a wrong one, and that one is taken for the other.
const NAMED = { balanced: '0.7,0.7,0.1', 'punish-only': '0.7,0.05,0.1', 'reward-only': '0.05,0.7,0.1' };

export const CHOICES = [PEOPLE, ...Object.keys(NAMED), 'own'];

// A word is meant for the last step.
export const NO_LAG = [1, 0, 0];

/** What the robot expected before it met its trainer: a name, or numbers. */
export function expectedNow() {
  const numbers = [...world.strategies()].map(number => Number(number.toFixed(6)));
  const strategies = Array.from({ length: numbers.length / 7 }, (_, at) => {
    const [plus, minus, mistakes, weight, ...lags] = numbers.slice(7 * at, 7 * at + 7);
    const text = [plus, minus, mistakes, ...(lags[0] === 1 ? [] : lags)].join();
    const name = Object.entries(NAMED).find(([, named]) => named === text)?.[0] || text;
    return numbers.length > 7 ? name + '*' + weight : name;
  });
  return strategies.join('; ') || PEOPLE;
}

const number = text => (text.trim() ? Number(text) : NaN);

/** Makes the robot expect this: a name, three or six numbers, or several of them, apart by semicolons, each with its weight behind a star. Throws where it
 * is none of that.
 * @param {string} text */
export function expectTrainer(text) {
  const strategies = text.trim() === PEOPLE ? [] : text.split(';').flatMap(one => {
    const [what, weight = '1'] = one.split('*');
    const [plus, minus, mistakes, ...lags] = (NAMED[what.trim()] || what).split(',').map(number);
    if (mistakes === undefined || ![0, 3].includes(lags.length)) throw new Error(t('believes.form'));
    return [plus, minus, mistakes, number(weight), ...(lags.length ? lags : NO_LAG)];
  });
  world.setStrategies(Float32Array.from(strategies));
}
