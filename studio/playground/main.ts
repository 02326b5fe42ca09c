// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The studio's page without a server: the playground.
import { mount } from 'svelte';
import App from '../src/App.svelte';
import '../src/styles/tokens.css';
import '../src/styles/studio.css';
import '../src/styles/page.css';
import '../src/styles/panels.css';
import { WorkerTransport } from './worker_transport';

const target = document.getElementById('app');
if (target) mount(App, { target, props: { transport: new WorkerTransport() } });
