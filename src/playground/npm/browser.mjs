import createNinebit from './engine.mjs';
import { loader } from './ninebit.mjs';

export { Ninebit, NinebitError } from './ninebit.mjs';
export const load = loader(createNinebit);
