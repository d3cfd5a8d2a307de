/**
 * What may stand at a place of an effect's JSON, by its schema: keys of the object there, or words of the value.
 */
import effectSchema from '../../../docs/effect.schema.json' with { type: 'json' };

/** @typedef {{label: string, apply: string, detail?: string}} Offer */
/** An open object or list: the key that is being read, and the keys that are there. @typedef {{list: boolean, key: string|null, keys: Set<string>}} Level */

/** @param {any} schema @returns {any[]} the schemas that a value may have */
function choices(schema) {
  if (!schema) return [];
  if (schema.$ref) return choices(/** @type {any} */ (effectSchema.$defs)[schema.$ref.replace('#/$defs/', '')]);
  return schema.anyOf ? schema.anyOf.flatMap(choices) : [schema];
}

/** The schemas of a member or an element. @param {any[]} schemas @param {Level} level */
function inside(schemas, level) {
  return schemas.flatMap((schema) => {
    if (level.list) return choices(schema.items);
    const { properties = {}, additionalProperties } = schema;
    if (level.key !== null && Object.hasOwn(properties, level.key)) return choices(properties[level.key]);
    return typeof additionalProperties === 'object' ? choices(additionalProperties) : [];
  });
}

/** The open objects and lists before a place, and the string that is open there. @param {string} text */
function levelsOf(text) {
  /** @type {Level[]} */
  const levels = [];
  /** @type {string|null} */
  let last = null;
  for (const [token] of text.matchAll(/"(?:[^"\\]|\\.)*"?|[{}[\],:]/gs)) {
    const level = levels.at(-1);
    if (token === '{' || token === '[') levels.push({ list: token === '[', key: null, keys: new Set() });
    else if (token === '}' || token === ']') levels.pop();
    else if (token === ':' && level && last !== null) {
      level.key = last;
      level.keys.add(last);
    } else if (token === ',' && level) level.key = null;
    last = token.startsWith('"') ? token.replace(/^"|"$/g, '') : null;
  }
  const open = /"(?:[^"\\]|\\.)*$/s.exec(text.replace(/"(?:[^"\\]|\\.)*"/gs, (word) => ' '.repeat(word.length)));
  return { levels, from: open ? open.index : text.length };
}

/**
 * @param {string} text of the effect, up to the place
 * @returns {{from: number, offers: Offer[]}|null} `from`: where what is offered begins
 */
export function effectOffers(text) {
  const word = /[\w.-]*$/.exec(text)?.[0] ?? '';
  const { levels, from } = levelsOf(text);
  const level = levels.at(-1);
  if (!level) return null;
  const begin = from < text.length ? from : text.length - word.length;
  /** @type {any[]} */
  let schemas = choices(effectSchema);
  for (const outer of levels.slice(0, -1)) schemas = inside(schemas, outer);
  if (!level.list && level.key === null) {
    const keys = schemas.flatMap(({ properties = {} }) => Object.entries(properties)).filter(([key]) => !level.keys.has(key));
    return { from: begin, offers: keys.map(([key, schema]) => ({ label: key, apply: `"${key}": `, detail: schema.description })) };
  }
  const words = inside(schemas, level).flatMap((schema) => schema.enum ?? (schema.type === 'boolean' ? [true, false] : schema.type === 'null' ? [null] : []));
  return { from: begin, offers: words.map((value) => ({ label: String(value), apply: JSON.stringify(value) })) };
}
