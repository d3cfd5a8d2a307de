// What the page of package_test.mjs runs: the same calls in a browser, their answers to the server.
import { load } from 'ninebit';
import { answers } from './answers.mjs';

let body;
try {
  body = JSON.stringify(answers(await load()));
} catch (error) {
  body = JSON.stringify(String(error));
}
await fetch('/answers', { method: 'POST', body });
