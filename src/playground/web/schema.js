/**
 * What is wrong with a value by a JSON Schema, in one sentence. It has the keywords of docs/effect.schema.json.
 */

/** @typedef {any} Schema */

/** The kinds of values: in words, and whether a value is one. @type {Map<string, [string, (value: unknown) => boolean]>} */
const kinds = new Map([
  ['object', ['an object', (value) => typeof value === 'object' && value !== null && !Array.isArray(value)]],
  ['array', ['a list', Array.isArray]],
  ['string', ['a string', (value) => typeof value === 'string']],
  ['number', ['a number', Number.isFinite]],
  ['integer', ['a whole number', Number.isInteger]],
  ['boolean', ['true or false', (value) => typeof value === 'boolean']],
  ['null', ['null', (value) => value === null]],
]);

/** The keywords that are read; others may only describe. */
export const keywords = ['$ref', '$defs', 'additionalProperties', 'anyOf', 'const', 'enum', 'items', 'maxItems', 'maximum', 'minItems', 'minimum',
  'pattern', 'properties', 'required', 'type'];

/** A key as one writes it behind what it is a key of. @param {string} key */
const step = (key) => (/^[A-Za-z_]\w*$/.test(key) ? `.${key}` : `[${JSON.stringify(key)}]`);

/** The words "a, b or c". @param {string[]} words */
const either = (words) => (words.length < 2 ? words.join() : `${words.slice(0, -1).join(', ')} or ${words.at(-1)}`);

/** @param {Schema} schema @param {number} value @param {string} place */
function ofNumber({ minimum = -Infinity, maximum = Infinity }, value, place) {
  const wanted = maximum === Infinity ? `${minimum} or more` : minimum === -Infinity ? `${maximum} or less` : `${minimum} to ${maximum}`;
  return value < minimum || value > maximum ? `${place} is ${value}; expected ${wanted}` : null;
}

/** @param {Schema} schema @param {any[]} value @param {string} place @param {Schema} root @returns {string|null} */
function ofList({ items, minItems = 0, maxItems = Infinity }, value, place, root) {
  if (value.length < minItems || value.length > maxItems) {
    const wanted = minItems === maxItems ? minItems : maxItems === Infinity ? `${minItems} or more` : `${minItems} to ${maxItems}`;
    return `${place} has ${value.length} values; expected ${wanted}`;
  }
  return items ? firstOf(value, (/** @type {any} */ one, /** @type {number} */ at) => complaint(items, one, `${place}[${at}]`, root)) : null;
}

/** @param {Schema} schema @param {any} value @param {string} place @param {Schema} root @returns {string|null} */
function ofObject({ properties = {}, required = [], additionalProperties = true }, value, place, root) {
  const missing = required.find((/** @type {string} */ key) => !Object.hasOwn(value, key));
  if (missing) return `${place} has no ${JSON.stringify(missing)}`;
  return firstOf(Object.keys(value), (key) => {
    if (Object.hasOwn(properties, key)) return complaint(properties[key], value[key], place + step(key), root);
    if (additionalProperties === false) return `${place} has the unknown key ${JSON.stringify(key)}; the keys here are ${either(Object.keys(properties))}`;
    return additionalProperties === true ? null : complaint(additionalProperties, value[key], place + step(key), root);
  });
}

/** The first complaint about one of the values, or `null`. @param {any[]} values @param {(value: any, at: number) => string|null} complain */
function firstOf(values, complain) {
  for (const [at, value] of values.entries()) {
    const found = complain(value, at);
    if (found) return found;
  }
  return null;
}

/**
 * Several schemas of which one must hold: the complaint of the one for this kind of value, or a list of the kinds.
 * @param {Schema[]} schemas
 * @param {any} value
 * @param {string} place
 * @param {Schema} root
 * @returns {string|null}
 */
function ofAny(schemas, value, place, root) {
  const found = schemas.map((schema) => complaint(schema, value, place, root));
  if (found.includes(null)) return null;
  const same = schemas.findIndex(({ type }) => kinds.get(type)?.[1](value));
  return same >= 0 ? found[same] : `${place} must be ${either(schemas.map(({ type }) => kinds.get(type)?.[0] ?? type))}`;
}

/**
 * @param {any} schema
 * @param {any} value
 * @param {string} place how the sentence names the value
 * @param {any} [root] the schema that has `$defs`
 * @returns {string|null} `null`: nothing is wrong
 */
export function complaint(schema, value, place, root = schema) {
  if (schema.$ref) return complaint(root.$defs[schema.$ref.replace('#/$defs/', '')], value, place, root);
  if (schema.anyOf) return ofAny(schema.anyOf, value, place, root);
  const words = schema.enum ?? ('const' in schema ? [schema.const] : null);
  if (words && !words.includes(value)) return `${place} must be ${either(words.map((/** @type {any} */ word) => JSON.stringify(word)))}`;
  const kind = kinds.get(schema.type);
  if (!kind) return null;
  if (!kind[1](value)) return `${place} must be ${kind[0]}`;
  if (schema.type === 'object') return ofObject(schema, value, place, root);
  if (schema.type === 'array') return ofList(schema, value, place, root);
  if (schema.type === 'string') return schema.pattern && !new RegExp(schema.pattern).test(value) ? `${place} must match ${schema.pattern}` : null;
  return ofNumber(schema, value, place);
}
