import { readFile } from 'node:fs/promises';
import createNinebit from './engine.cjs';
import { loader } from './ninebit.mjs';

export { Ninebit, NinebitError } from './ninebit.mjs';
export const load = loader(createNinebit, () => readFile(new URL('./engine.wasm', import.meta.url)));
