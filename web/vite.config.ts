import { defineConfig } from "vite";

// Relative addresses: the page also works behind a proxy that serves it below a prefix.
export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    // Every file is an asset of its own: the policy of the page allows no `data:` address.
    assetsInlineLimit: 0,
    // What the licences of the bundled packages ask to be told with them.
    license: { fileName: "assets/licenses.txt" },
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
  },
  // `npm run dev` shows the page of these sources over a service on the usual port.
  server: { proxy: { "/v1": "http://127.0.0.1:8080", "/openapi.json": "http://127.0.0.1:8080" } },
});
