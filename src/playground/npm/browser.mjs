import createNinebit from './engine.mjs';
import { Ninebit, NinebitError } from './ninebit.mjs';

export { Ninebit, NinebitError };

export async function load() {
  return new Ninebit(await createNinebit({ print() {}, printErr() {} }));
}
