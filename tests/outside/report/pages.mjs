// A page of write_samples.cpp in headless Chromium, and what is drawn on it.
import { mkdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

// From the working folder, where `npm ci` puts it.
export const module = createRequire(path.join(process.cwd(), 'package.json'));
const { chromium } = module('playwright-core');
export const samples = process.env.SAMPLES;
export const pictures = path.join(samples, '..', 'pictures');
const hangs = 120_000;  // ms; for what never comes, not for a busy machine
let browser;

export async function openBrowser() {
  mkdirSync(pictures, { recursive: true });
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || '/usr/bin/chromium-headless-shell',
    args: ['--no-sandbox', '--disable-dev-shm-usage'],
    timeout: hangs,
  });
}
export const closeBrowser = () => browser?.close();

/** Until what was asked for is drawn: a frame begins, draws, and the next one begins. */
export const shown = (page) => page.evaluate(() => new Promise((resolve) => {
  requestAnimationFrame(() => requestAnimationFrame(() => resolve()));
}));

/** Open a report; whatever it requests, prints or throws is recorded. */
export async function open(name, options = {}) {
  const { width = 1200, ...rest } = options;
  const context = await browser.newContext({ viewport: { width, height: 900 }, ...rest });
  context.setDefaultTimeout(hangs);
  const page = await context.newPage();
  const seen = { requests: [], complaints: [] };
  page.on('request', (request) => seen.requests.push(request.url()));
  page.on('console', (message) => seen.complaints.push(message.text()));
  page.on('pageerror', (error) => seen.complaints.push(String(error)));
  const url = pathToFileURL(path.join(samples, name, 'report.html')).href;
  await page.goto(url);
  if (rest.javaScriptEnabled !== false) await shown(page);
  return { page, seen, url, close: () => context.close() };
}

/** The opaque colours of each canvas, with their numbers of pixels. */
export const drawn = (page) => page.$$eval('.uplot canvas', (canvases) => canvases.map((canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const colors = new Map();
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] !== 255) continue;
    const color = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
    colors.set(color, (colors.get(color) || 0) + 1);
  }
  return [...colors].sort((a, b) => b[1] - a[1]).map(([color, n]) => ({ color, n }));
}));

const hex = (text) => parseInt(text.trim().slice(1), 16);
export const colorOf = (page, name) => page.evaluate((n) =>
  getComputedStyle(document.documentElement).getPropertyValue(n), name).then(hex);
export const has = (canvas, color) => canvas.some((entry) => entry.color === color && entry.n > 100);

/** How many colours each drawing holds, and how many points of its canvas are painted. */
export const painted = (page) => page.$$eval('.drawing canvas', (canvases) => canvases.map((canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const colors = new Set();
  let points = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] !== 255) continue;
    ++points;
    colors.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
  }
  return { colors: colors.size, points, width: canvas.clientWidth, text: canvas.toDataURL() };
}));
