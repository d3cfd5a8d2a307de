import createNinebit from './engine.cjs';
import { Ninebit, NinebitError } from './ninebit.mjs';

export { Ninebit, NinebitError };

export async function load() {
  return new Ninebit(await createNinebit({ print() {}, printErr() {} }));
}
