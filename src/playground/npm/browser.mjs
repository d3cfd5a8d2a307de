import createNinebit from './engine.mjs';
import { loader } from './ninebit.mjs';

export { Ninebit, NinebitError } from './ninebit.mjs';
export const load = loader(createNinebit, async () => {
  const answer = await fetch(new URL('./engine.wasm', import.meta.url));
  if (!answer.ok) throw new Error(`engine.wasm: ${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
});
