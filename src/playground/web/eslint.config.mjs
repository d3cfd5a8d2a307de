// What ESLint checks of the page's modules, its bundler and the tests in browsers: mistakes, not layout.
import js from '@eslint/js';

const browser = ['AbortController', 'Blob', 'CompressionStream', 'DataTransfer', 'DecompressionStream', 'DOMException', 'DragEvent', 'ErrorEvent', 'Event',
  'File', 'FileReader', 'HTMLElement', 'Image', 'ImageData', 'KeyboardEvent', 'OffscreenCanvas', 'PointerEvent', 'ResizeObserver', 'Response', 'Storage',
  'TextDecoder', 'TextEncoder', 'URL', 'URLSearchParams', 'WheelEvent', 'Worker', 'atob', 'btoa', 'cancelAnimationFrame', 'clearTimeout', 'console',
  'createImageBitmap', 'document', 'fetch', 'getComputedStyle', 'history', 'indexedDB', 'localStorage', 'location', 'navigator', 'performance',
  'requestAnimationFrame', 'self', 'setTimeout', 'structuredClone', 'window', 'Element', 'Buffer', 'process', 'MouseEvent', 'IDBObjectStore', 'innerHeight'];

export default [
  js.configs.recommended,
  {
    languageOptions: { ecmaVersion: 2025, sourceType: 'module', globals: Object.fromEntries(browser.map((name) => [name, 'readonly'])) },
    linterOptions: { reportUnusedDisableDirectives: 'error' },
    rules: {
      eqeqeq: 'error', 'no-var': 'error', 'prefer-const': 'error', 'no-shadow': 'error', 'no-implicit-coercion': 'error', 'no-unused-expressions': 'error',
      'no-eval': 'error', 'no-implied-eval': 'error', 'no-new-func': 'error', 'object-shorthand': 'error', 'no-else-return': 'off',
      'no-unused-vars': ['error', { argsIgnorePattern: '^_' }], 'no-control-regex': 'off', 'no-promise-executor-return': 'off',
    },
  },
  // `before` and `after` are what Node calls its hooks, and good names of values.
  { files: ['**/*_test.mjs', '**/support.mjs'], rules: { 'no-shadow': 'off' } },
];
